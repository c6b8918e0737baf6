package candela.bench.robustness

import java.util.SplittableRandom

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.math.*

/** Inputs of BSDFs at the ends of the hemisphere: what comes out must be numbers, none of them
  * negative.
  */
object ExtremeInputs:
  /** Unit vectors down to a cosine of 1e-45, along axes, and anything between. */
  private def direction(random: SplittableRandom): Vec3 =
    val small = Math.pow(10, -45 * random.nextDouble())
    val z = random.nextInt(8) match
      case 0 => 0.0
      case 1 => 1.0
      case 2 => 1e-45
      case 3 | 4 => small
      case 5 => 1 - Math.pow(10, -8 * random.nextDouble())
      case _ => random.nextDouble()
    val phi = random.nextInt(4) match
      case 0 => 0.0
      case 1 => Math.PI / 2
      case _ => 2 * Math.PI * random.nextDouble()
    val r = Math.sqrt(1 - z * z)
    val side = if random.nextBoolean() then z else -z
    Vec3((r * Math.cos(phi)).toFloat, (r * Math.sin(phi)).toFloat, side.toFloat)

  private def number(random: SplittableRandom): Float = random.nextInt(8) match
    case 0 => 0f
    case 1 => OneMinusEpsilon
    case 2 => 1e-30f
    case _ => Math.min(random.nextDouble().toFloat, OneMinusEpsilon)

  private def isSane(x: Float) = java.lang.Float.isFinite(x) && x >= 0f
  private def isSane(c: Rgb) = c.isFinite && c.r >= 0f && c.g >= 0f && c.b >= 0f

  def tally(bsdf: Bsdf, trials: Trials): Tally =
    val random = SplittableRandom(trials.seed(1))
    Tally.of(trials.count)(_ => fault(bsdf, direction(random), direction(random), random))

  private def fault(bsdf: Bsdf, wo: Vec3, wi: Vec3, random: SplittableRandom): String =
    val (f, pdf) = (bsdf.f(wo, wi), bsdf.pdf(wo, wi))
    val s = bsdf.sample(wo, number(random), number(random), number(random))
    // The product with the cosine is what integrators need
    if !isSane(f) || !isSane(pdf) || !isSane(f * Math.abs(wi.z)) then
      s"f $f, pdf $pdf for $wo $wi"
    else if !isSane(s.weight) || !isSane(s.pdf) then s"weight ${s.weight}, pdf ${s.pdf} for $wo"
    else if !(Math.abs(s.wi.length - 1f) < 1e-5f) then s"direction ${s.wi} for $wo"
    // Weights above 1 are where the density lacks something; this much it may
    else if !(s.weight.max <= 1e6f) then s"weight ${s.weight} for $wo"
    else if !isSane(s.eta) || s.eta == 0f then s"eta ${s.eta} for $wo"
    else Tally.Sound
