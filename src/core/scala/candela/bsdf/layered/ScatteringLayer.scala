package candela.bsdf.layered

import candela.bsdf.{Bounce, Bsdf, BsdfFlags, Hemisphere, LeanBsdf, Material}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.sampling.PhaseFunction
import candela.textures.{RgbTexture, Textured}

/** A flat layer of a medium: light passes, or is scattered once.
  *
  * @param depth  optical thickness
  * @param albedo fraction of the extinction that is scattering
  *
  * Source: Hanrahan and Krueger, "Reflection from Layered Surfaces due to Subsurface Scattering",
  * SIGGRAPH 1993, §5.1.
  */
final class ScatteringLayer(depth: Rgb, albedo: Rgb, phase: PhaseFunction) extends LeanBsdf:

  /** Fraction of the light that passes unscattered. */
  private def passed(cosine: Float): Rgb = depth.map(d => exp(-d / cosine))

  /** The probability of sampling it. */
  private def chance(wo: Vec3): Float =
    val cosine = Hemisphere.absCos(wo)
    if cosine < Hemisphere.Horizon then 0f
    else
      val share = passed(cosine).average
      // What isn't scattered passes
      if !albedo.isBlack then share else if share > 0f then 1f else 0f

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isLevel(wo, wi) then Rgb.Black
    else
      val (a, b) = (Hemisphere.absCos(wo).toDouble, Hemisphere.absCos(wi).toDouble)
      val shape = if wo.z * wi.z > 0f then reflected(_, a, b) else transmitted(_, a, b)
      val value = phase.value(wo, wi)
      Rgb(shape(depth.r), shape(depth.g), shape(depth.b)) * albedo * value

  private def reflected(depth: Float, a: Double, b: Double): Float =
    (-Math.expm1(-depth * (1.0 / a + 1.0 / b)) / (a + b)).toFloat

  /** (e^(−d/a) − e^(−d/b)) / (a − b), without cancellation. */
  private def transmitted(depth: Float, a: Double, b: Double): Float =
    val (steep, level) = if a > b then (a, b) else (b, a)
    val apart = steep - level
    val x = depth * apart / (steep * level)
    val ratio = if x > 1e-9 then -Math.expm1(-x) / x else 1.0
    (Math.exp(-depth / steep) * ratio * depth / (steep * level)).toFloat

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isLevel(wo, wi) then 0f else (1f - chance(wo)) * phase.value(wo, wi)

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val straight = chance(wo)
    if choice < straight then
      val weight = passed(Hemisphere.absCos(wo)).map(_ / straight)
      out.set(-wo, weight, straight, isSpecular = true)
    else
      val wi = phase.sample(wo, u1, u2)
      val density = pdf(wo, wi)
      if density <= 0f then out.absorb()
      else out.set(wi, f(wo, wi) * (Hemisphere.absCos(wi) / density), density, isSpecular = false)

  val flags: BsdfFlags =
    BsdfFlags.Glossy | BsdfFlags.Specular | BsdfFlags.Transmissive | BsdfFlags.Choosing

  override def regularized: Bsdf = this

/** [[ScatteringLayer]]; the coefficients are at least 0, in the unit of 1 / `thickness`. */
final class ScatteringLayerMaterial(
    sigmaA: RgbTexture,
    sigmaS: RgbTexture,
    thickness: Float,
    phase: PhaseFunction
) extends Material,
      Textured(sigmaA, sigmaS):
  def bsdf(at: ShadingPoint): Bsdf =
    val scattering = sigmaS.positive(at)
    val extinction = sigmaA.positive(at) + scattering
    val albedo = scattering / extinction.map(c => if c > 0f then c else 1f)
    // Also of layers without end
    val depth = extinction.map(c => if c > 0f then c * thickness else 0f)
    ScatteringLayer(depth, albedo, phase)
