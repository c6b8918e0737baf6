package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** A sum of BSDFs.
  *
  * `sample` samples one lobe and combines the pdfs of all by MIS (one-sample balance heuristic),
  * unless the direction is specular: no other lobe can have produced it.
  *
  * @param lobes         at least one
  * @param probabilities of sampling each lobe; positive where the lobe is not black; sum 1
  */
final class Lobes(lobes: Array[Bsdf], probabilities: Array[Float]) extends Bsdf:

  /** The lobes and their sampling probabilities. */
  def components: Seq[(Bsdf, Float)] = lobes.toSeq.zip(probabilities)

  def f(wo: Vec3, wi: Vec3): Rgb =
    var sum = lobes(0).f(wo, wi)
    var i = 1
    while i < lobes.length do
      sum = sum + lobes(i).f(wo, wi)
      i += 1
    sum

  override def reflectedAcross(wo: Vec3, wi: Vec3): Rgb =
    lobes.foldLeft(Rgb.Black)((sum, lobe) => sum + lobe.reflectedAcross(wo, wi))

  def pdf(wo: Vec3, wi: Vec3): Float =
    var sum = 0f
    var i = 0
    while i < lobes.length do
      sum += probabilities(i) * lobes(i).pdf(wo, wi)
      i += 1
    sum

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    // The last lobe also covers the rounding error of the sum.
    var i = 0
    var remaining = choice
    while i < lobes.length - 1 && remaining >= probabilities(i) do
      remaining -= probabilities(i)
      i += 1
    val p = probabilities(i)
    val s = lobes(i).sample(wo, clamp(remaining / p, 0f, OneMinusEpsilon), u1, u2)
    if s.pdf == 0f then BsdfSample.Absorbed
    else if s.isSpecular then
      BsdfSample(s.wi, s.weight * (1f / p), s.pdf * p, isSpecular = true, s.eta)
    else
      val density = pdf(wo, s.wi)
      if density <= 0f then BsdfSample.Absorbed
      else
        val weight = f(wo, s.wi) * (Hemisphere.absCos(s.wi) / density)
        BsdfSample(s.wi, weight, density, isSpecular = false, s.eta)

  private val specular: Float =
    lobes.indices.filter(lobes(_).isSpecular).map(probabilities(_)).sum

  override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    if specular <= 0f then BsdfSample.Absorbed
    else
      // As `sample`, restricted to the specular lobes
      var remaining = choice * specular
      var chosen = -1
      var i = 0
      while i < lobes.length do
        if lobes(i).isSpecular && (chosen < 0 || remaining >= 0f) then
          chosen = i
          remaining -= probabilities(i)
        i += 1
      val p = probabilities(chosen) / specular
      val remapped = clamp(1f + remaining / probabilities(chosen), 0f, OneMinusEpsilon)
      val s = lobes(chosen).sample(wo, remapped, 0.5f, 0.5f)
      BsdfSample(s.wi, s.weight * (1f / p), s.pdf * p, s.isSpecular, s.eta)

  val flags: BsdfFlags =
    var combined = BsdfFlags.Choosing
    var transmissive = 0
    var i = 0
    while i < lobes.length do
      combined = combined | lobes(i).flags
      if lobes(i).isTransmissive then transmissive += 1
      i += 1
    // Light may be compressed by one of two lobes that transmit it, and not by the other
    if transmissive < 2 then combined else combined | BsdfFlags.NonReciprocal

  override val scattersThrough: Boolean =
    var through = false
    var i = 0
    while i < lobes.length do
      if lobes(i).scattersThrough then through = true
      i += 1
    through

  override def straight(wo: Vec3): Rgb =
    var sum = Rgb.Black
    var i = 0
    while i < lobes.length do
      sum = sum + lobes(i).straight(wo)
      i += 1
    sum

  override def diffuseReflectance(wo: Vec3): Rgb =
    lobes.foldLeft(Rgb.Black)((sum, lobe) => sum + lobe.diffuseReflectance(wo))

  override def regularized: Bsdf = Lobes(lobes.map(_.regularized), probabilities)

object Lobes:

  /** Collects lobes with estimated albedos and builds the simplest exact [[Bsdf]].
    *
    * Half of the samples follow the estimates. The other half are distributed equally, because
    * glossy lobes can be many times brighter at grazing angles than on average.
    */
  final class Builder:
    private var lobes = Array.empty[Bsdf]
    private var albedos = Array.empty[Float]

    /** Skips black lobes. */
    def add(lobe: => Bsdf, albedo: Float): Builder =
      if albedo > 0f then
        lobes = lobes :+ lobe
        albedos = albedos :+ albedo
      this

    /** Adds the lobes of `bsdf`, times `scale`. */
    def addScaled(bsdf: Bsdf, scale: Rgb): Builder = bsdf match
      case several: Lobes =>
        for (lobe, share) <- several.components do add(scaled(lobe, scale), share * scale.max)
        this
      case one => add(scaled(one, scale), scale.max)

    private def scaled(lobe: Bsdf, scale: Rgb): Bsdf =
      if scale == Rgb.White then lobe else Scaled(lobe, scale)

    def result: Bsdf =
      if lobes.isEmpty then Lambert.Black
      else if lobes.length == 1 then lobes(0)
      else
        val total = albedos.sum
        Lobes(lobes, albedos.map(a => 0.5f * a / total + 0.5f / lobes.length.toFloat))

/** `inner` multiplied by `scale`. */
final class Scaled(inner: Bsdf, scale: Rgb) extends WrappedBsdf(inner):
  override def f(wo: Vec3, wi: Vec3): Rgb = inner.f(wo, wi) * scale
  override def reflectedAcross(wo: Vec3, wi: Vec3): Rgb = inner.reflectedAcross(wo, wi) * scale

  override protected def changed(wo: Vec3, s: BsdfSample): BsdfSample =
    BsdfSample(s.wi, s.weight * scale, s.pdf, s.isSpecular, s.eta)

  override def straight(wo: Vec3): Rgb = inner.straight(wo) * scale
  override def diffuseReflectance(wo: Vec3): Rgb = inner.diffuseReflectance(wo) * scale
  override def regularized: Bsdf = Scaled(inner.regularized, scale)

/** Transmits what `reflection` would reflect.
  *
  * Source: PBRT 2nd ed., §8.1 ("BRDFToBTDF").
  */
final class SentThrough(reflection: Bsdf) extends WrappedBsdf(reflection):
  override def f(wo: Vec3, wi: Vec3): Rgb = reflection.f(wo, Hemisphere.flipped(wi))
  override def pdf(wo: Vec3, wi: Vec3): Float = reflection.pdf(wo, Hemisphere.flipped(wi))

  override protected def changed(wo: Vec3, s: BsdfSample): BsdfSample =
    BsdfSample(Hemisphere.flipped(s.wi), s.weight, s.pdf, s.isSpecular, s.eta)

  override def flags: BsdfFlags = reflection.flags | BsdfFlags.Transmissive
  override def scattersThrough: Boolean = !isSpecular
  override def regularized: Bsdf = SentThrough(reflection.regularized)
