package candela.bsdf.measured

import candela.bsdf.{Bsdf, BsdfFlags, BsdfSample, Hemisphere}
import candela.color.Rgb
import candela.math.*
import candela.sampling.WarpTable

/** A measured BRDF in an adaptive parameterisation: the microfacet distribution warps the domain in
  * which the rest is tabulated. Not reciprocal, as no measurement is.
  *
  * Tables are over the unit square: x is √(2θ/π) of a direction's angle to the normal, y its
  * azimuth (from −π, over 2π). Parameterised tables depend on the azimuth and angle of `wo`.
  *
  * @param ndf         microfacet normal distribution
  * @param sigma       projected microfacet area by direction
  * @param visible     distribution of visible normals for `wo`
  * @param luminance   sampling density over uniform points of `visible`
  * @param spectra     measured values there, in three channels
  * @param isIsotropic whether azimuths are relative to that of `wo`
  *
  * Source: Dupuy and Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and
  * Rendering", SIGGRAPH Asia 2018.
  */
final class AdaptiveReflection(
    ndf: WarpTable,
    sigma: WarpTable,
    visible: WarpTable,
    luminance: WarpTable,
    spectra: WarpTable,
    isIsotropic: Boolean
) extends Bsdf:
  import AdaptiveReflection.*

  def f(wo: Vec3, wi: Vec3): Rgb =
    val i = upper(wo, wi)
    val across = upper(wo, wo) + i
    if !Hemisphere.isSameSide(wo, wi) || across.isZero then Rgb.Black
    else
      val facet = Facet(upper(wo, wo), across.normalized)
      val measured = spectra.Blend(facet.phi, facet.theta)
      val area = sigma.Blend(0f, 0f)(side(facet.theta), (facet.phi + Pi) * InvTwoPi)
      val denominator = 4f * i.z * area
      if !(denominator > 0f) then Rgb.Black
      else
        val scale = ndf.Blend(0f, 0f)(facet.x, facet.y) / denominator
        val x = facet.vndf.x
        val y = facet.vndf.y
        Rgb(measured(x, y, 0), measured(x, y, 1), measured(x, y, 2))
          .map(c => Math.max(c * scale, 0f))

  /** Table coordinates of a microfacet.
    *
    * @param o direction in the upper hemisphere
    * @param m microfacet normal
    */
  private final class Facet(o: Vec3, m: Vec3):
    val theta: Float = angle(o)
    val phi: Float = azimuth(o)
    val x: Float = side(angle(m))
    val y: Float =
      val turn = ((if isIsotropic then azimuth(m) - phi else azimuth(m)) + Pi) * InvTwoPi
      turn - Math.floor(turn.toDouble).toFloat
    val vndf = visible.Blend(phi, theta)
    vndf.invert(x, y)

  def pdf(wo: Vec3, wi: Vec3): Float =
    val o = upper(wo, wo)
    val across = o + upper(wo, wi)
    if !Hemisphere.isSameSide(wo, wi) || across.isZero then 0f
    else
      val m = across.normalized
      val facet = Facet(o, m)
      val vndf = facet.vndf
      val bright = luminance.Blend(facet.phi, facet.theta)
      val onSquare = vndf(facet.x, facet.y) * bright(vndf.x, vndf.y)
      // Jacobian from the unit square to solid angle
      val sine = sqrt(m.x * m.x + m.y * m.y)
      onSquare / (4f * (o dot m) * Math.max(2f * Pi * Pi * facet.x * sine, 1e-6f))

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val o = upper(wo, wo)
    val theta = angle(o)
    val phi = azimuth(o)
    val bright = luminance.Blend(phi, theta)
    bright.sample(u1, u2)
    val vndf = visible.Blend(phi, theta)
    vndf.sample(bright.x, bright.y)
    val polar = 0.5f * Pi * vndf.x * vndf.x
    val phiM = (2f * vndf.y - 1f) * Pi + (if isIsotropic then phi else 0f)
    val m = Vec3(sin(polar) * cos(phiM), sin(polar) * sin(phiM), cos(polar))
    val cosM = o dot m
    val i = Hemisphere.reflected(o, m, cosM).normalized
    if o.z == 0f || cosM <= 0f || i.z <= 0f then BsdfSample.Absorbed
    else
      val wi = upper(wo, i)
      val density = pdf(wo, wi)
      val color = if density > 0f then f(wo, wi) * (i.z / density) else Rgb.Black
      if color.isBlack || !color.isFinite then BsdfSample.Absorbed
      else BsdfSample(wi, color, density, isSpecular = false)

  def flags: BsdfFlags = BsdfFlags.Glossy | BsdfFlags.NonReciprocal | BsdfFlags.Choosing

object AdaptiveReflection:

  /** Below the surface, the measurement applies rotated by 180 degrees about both axes. */
  private def upper(wo: Vec3, w: Vec3): Vec3 = if wo.z < 0f then -w else w

  /** The angle to the normal, without the cancellation of an arc cosine. */
  private def angle(w: Vec3): Float =
    Math.atan2(Math.sqrt(w.x.toDouble * w.x + w.y.toDouble * w.y), w.z.toDouble).toFloat
  private def azimuth(w: Vec3): Float = Math.atan2(w.y.toDouble, w.x.toDouble).toFloat
  private def side(theta: Float): Float = sqrt(theta * (2f / Pi))
