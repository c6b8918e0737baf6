package candela.stability

import java.util.SplittableRandom

import org.scalatest.Assertions.assert

import candela.bsdf.*
import candela.color.Rgb
import candela.math.*

/** BSDFs at the ends of their parameters and of the hemisphere. */
object Scattering extends Group(
      Extremes.all.map((name, bsdf) =>
        Case(s"$name scatters numbers, whatever the directions", 4000, 100_000_000L)(count =>
          Extremes.staysFinite(bsdf, count)
        )
      ) ++ Furnaces.cases ++ Interfaces.cases
    )

class ScatteringSuite extends GroupSuite(Scattering)

private object Extremes:
  private val gray = Rgb.gray(0.5f)
  private val indices = Seq(1f, Math.nextUp(1f), 1 + 1e-4f, 1 + 1e-3f, 0.999f, 0.2f, 1e-3f, 1e3f)
  private val alphas =
    Seq((0f, 0f), (1e-3f, 1e-3f), (0f, 1e-3f), (1e-4f, 1f), (1f, 1f), (30f, 1e-2f))

  private def glossy(a: (Float, Float)) = TrowbridgeReitz(a._1, a._2)
  private val metals = Seq(
    "no index at all" -> ConductorReflectance(Rgb.Black, Rgb.Black),
    "index 1e-6" -> ConductorReflectance(Rgb.gray(1e-6f), Rgb.gray(1e-6f)),
    "index 1e6" -> ConductorReflectance(Rgb.gray(1e6f), Rgb.gray(1e6f)),
    "index 1" -> ConductorReflectance(Rgb.White, Rgb.Black),
    "critical index" -> ConductorReflectance(Rgb.gray(0.5f), Rgb.gray(1e-20f))
  )

  val all: Seq[(String, Bsdf)] =
    Seq[(String, Bsdf)](
      "matte of albedo 1" -> Lambert(Rgb.White),
      "clay of 90 degrees" -> OrenNayar(Rgb.White, 90f),
      "a sheet" -> DiffuseTransmission(gray, gray),
      "a pane of index 1" -> ThinDielectric(1f),
      "a pane of index 1e3" -> ThinDielectric(1e3f),
      "varnish" -> FresnelBlend(gray, Rgb.gray(0.04f), TrowbridgeReitz(1e-3f, 1e-3f)),
      "white varnish" -> FresnelBlend(Rgb.White, Rgb.White, CosinePower(Float.PositiveInfinity))
    ) ++
      (for eta <- indices; a <- alphas
      yield s"glass of index $eta and roughness $a" -> Dielectric(glossy(a), eta)) ++
      (for (name, curve) <- metals; a <- alphas
      yield s"metal of $name and roughness $a" -> Conductor(glossy(a), curve)) ++
      (for e <- Seq(0f, 1f, 1e4f, Float.PositiveInfinity, Float.NaN)
      yield s"metal of exponent $e" ->
        MicrofacetReflection(CosinePower(e), FullReflectance)) ++
      (for h <- Seq(-1f, 0f, 1f); beta <- Seq(0f, 0.3f, 1f); eta <- Seq(1f, 1.55f, 10f)
      yield s"hair at $h of roughness $beta and index $eta" ->
        Hair(h, eta, Rgb(0f, 1f, 1e6f), HairShape(beta, beta, 2f))) ++
      (for a <- Seq(0f, 1f); thick <- Seq(0f, 100f); eta <- Seq(Math.nextUp(1f), 1.5f, 20f)
      yield
        val top = TrowbridgeReitz(a, a)
        val coat = Coats().of(top, eta, thick)
        s"coated diffuse of index $eta, roughness $a, thickness $thick" ->
          new CoatedDiffuse(Rgb.White.map(CoatedDiffuse.series(_, coat, 50)), top, coat))

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

  def staysFinite(bsdf: Bsdf, count: Long): Unit =
    val random = SplittableRandom(1)
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
