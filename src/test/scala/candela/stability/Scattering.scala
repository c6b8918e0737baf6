package candela.stability

import java.util.SplittableRandom

import Checks.assert

import candela.bsdf.{Bsdf, DiffuseTransmission, Directions, Lambert}
import candela.bsdf.microfacet.{
  Dielectric, Mirror, SmoothDielectric, ThinDielectric, TrowbridgeReitz
}
import candela.color.Rgb
import candela.math.*

/** BSDFs at the ends of their parameters and of the hemisphere: 10⁸ inputs a kind, whose variants
  * share them.
  */
object Scattering extends Group(
      ExtremeBsdfs.all.flatMap(kind =>
        kind.variants.map((name, bsdf) =>
          val long = (100_000_000L + kind.variants.size - 1) / kind.variants.size
          val words = s"$name scatters numbers, whatever the directions"
          Case.sliced(words, kind.quick, long, s"inputs of ${kind.name}")(
            Extremes.staysFinite(bsdf, _)
          )
        )
      ) ++ Furnaces.cases ++ Interfaces.cases
    )

class ScatteringSuite extends GroupSuite(Scattering)

private object Extremes:
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

  def staysFinite(bsdf: Bsdf, trials: Trials): Unit =
    val count = trials.count
    val random = SplittableRandom(trials.seed(1))
    var i = 0L
    while i < count do
      val (wo, wi) = (direction(random), direction(random))
      val (f, pdf) = (bsdf.f(wo, wi), bsdf.pdf(wo, wi))
      assert(isSane(f) && isSane(pdf), s"f $f, pdf $pdf for $wo $wi")
      // What integrators multiply
      assert(isSane(f * Math.abs(wi.z)), s"f $f for $wo $wi")
      val s = bsdf.sample(wo, number(random), number(random), number(random))
      assert(isSane(s.weight) && isSane(s.pdf), s"weight ${s.weight}, pdf ${s.pdf} for $wo")
      assert(Math.abs(s.wi.length - 1f) < 1e-5f, s"${s.wi} for $wo")
      // Weights above 1 are where the density lacks something; this much it may
      assert(s.weight.max <= 1e6f, s"weight ${s.weight} for $wo")
      assert(s.eta > 0f && java.lang.Float.isFinite(s.eta), s"eta ${s.eta} for $wo"): Unit
      i += 1

/** In a white furnace what conserves energy is invisible: the mean weight is 1. */
private object Furnaces:
  private val lossless: Seq[(String, Bsdf)] = Seq(
    "matte" -> Lambert(Rgb.White),
    "a sheet" -> DiffuseTransmission(Rgb.gray(0.25f), Rgb.gray(0.75f)),
    "a mirror" -> Mirror(Rgb.White),
    "a pane" -> ThinDielectric(1.5f),
    "glass" -> SmoothDielectric(1.5f),
    "glass of index 1 + 1e-7" -> SmoothDielectric(Math.nextUp(1f)),
    "glass seen from within" -> SmoothDielectric(1 / 1.5f),
    "glass of a roughness below all" -> Dielectric(TrowbridgeReitz(0f, 0f), 1.5f),
    "rough glass of index 1" -> Dielectric(TrowbridgeReitz(1f, 1f), 1f)
  )

  val cases: Seq[Case] =
    for (name, bsdf) <- lossless
    yield Case(s"$name is invisible in a white furnace", 20000, 10_000_000L)(isInvisible(bsdf))

  /** Each weight undoes the change of radiance by refraction; it is 1 for all these lobes, so that
    * no noise is left.
    */
  private def isInvisible(bsdf: Bsdf)(count: Long): Unit =
    val random = SplittableRandom(2)
    var i = 0L
    while i < count do
      val wo = Directions.uniform(random)
      def u() = Math.min(random.nextDouble().toFloat, OneMinusEpsilon)
      val s = bsdf.sample(wo, u(), u(), u())
      val weight = s.weight.g * s.eta * s.eta
      assert(Math.abs(weight - 1f) <= 1e-3f, s"weight $weight for $wo"): Unit
      i += 1
