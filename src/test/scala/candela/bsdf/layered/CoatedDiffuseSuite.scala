package candela.bsdf.layered

import java.util.SplittableRandom

import candela.bsdf.{Bsdf, BsdfLaws, Directions, Fresnel, Statistics}
import candela.bsdf.microfacet.TrowbridgeReitz
import candela.color.Rgb
import candela.math.*

class CoatedDiffuseSuite extends BsdfLaws:
  private val coats = Coats()

  private def coated(
      albedo: Rgb,
      alphaX: Float,
      alphaY: Float,
      eta: Float = 1.5f,
      thickness: Float = 0.01f,
      baseHits: Int = 5
  ): CoatedDiffuse =
    val top = TrowbridgeReitz(alphaX, alphaY)
    CoatedDiffuse(
      BaseSeries.OfColor(albedo, baseHits, baseHits),
      top,
      coats.of(top, eta, thickness)
    )

  obeysLaws("smooth coat", coated(Rgb(0.2f, 0.5f, 0.9f), 0f, 0f))
  obeysLaws("smooth coat on white", coated(Rgb.White, 0f, 0f, thickness = 0f, baseHits = 200))
  obeysLaws("rough coat", coated(Rgb(0.2f, 0.5f, 0.9f), 0.4f, 0.4f))
  obeysLaws("brushed coat", coated(Rgb.gray(0.8f), 0.3f, 0.7f))
  obeysLaws("nearly smooth coat", coated(Rgb.gray(0.5f), 0.001f, 0.001f), isNarrow = true)
  obeysLaws("coat of nothing", coated(Rgb.gray(0.5f), 0.3f, 0.3f, eta = 1f))
  obeysLaws("black base", coated(Rgb.Black, 0.4f, 0.4f))

  test("a smooth coat that absorbs nothing, on white, loses nothing"):
    val bsdf = coated(Rgb.White, 0f, 0f, thickness = 0f, baseHits = 200)
    val random = SplittableRandom(8)
    for wo <- Directions.few do
      val power = Statistics()
      for _ <- 0 until 20000 do
        val s = bsdf.sample(wo, random.nextFloat(), random.nextFloat(), random.nextFloat())
        power.add(s.weight.r)
      // 1e-4: the integrals of the coat, magnified by the series.
      assert(Math.abs(power.mean - 1) < 4.5 * power.error + 1e-4, s"$power at $wo")

  private val cases = Seq(
    (0f, 0f, 0.2f),
    (0f, 0f, 0.9f),
    (0.001f, 0.001f, 0.2f),
    (0.001f, 0.001f, 0.9f),
    (0.1f, 0.1f, 0.2f),
    (0.1f, 0.1f, 0.9f),
    (0.3f, 0.3f, 0.2f),
    (0.3f, 0.3f, 0.9f),
    (0.15f, 0.6f, 0.9f)
  )

  for (ax, ay, albedo) <- cases do
    test(s"alpha $ax, $ay, base of albedo $albedo: scatters like walks through the layers"):
      for (theta, phi) <- Seq((20.0, 0.0), (65.0, 60.0)) do
        agreesWithWalks(coated(Rgb.gray(albedo), ax, ay), ax, ay, albedo, Directions.at(theta, phi))

  /** Compares the power that leaves into each of eight parts of the hemisphere, at the top and
    * below.
    */
  private def agreesWithWalks(bsdf: Bsdf, ax: Float, ay: Float, albedo: Float, wo: Vec3): Unit =
    val n = 100000
    val random = SplittableRandom(9)
    val walk = LayerWalk(ax, ay, 1.5, 0.01, albedo, 10, random)
    val (walked, sampled) = (Array.fill(9)(Statistics()), Array.fill(9)(Statistics()))
    def addTo(parts: Array[Statistics], part: Int, weight: Double): Unit =
      for i <- 0 until 8 do parts(i).add(if i == part then weight else 0)
      parts(8).add(weight)
    for _ <- 0 until n do
      walk.walk(Way(wo.x, wo.y, wo.z))
      val way = walk.direction
      addTo(walked, if walk.weight > 0 then part(way.y, way.z) else -1, walk.weight)
      val s = bsdf.sample(wo, random.nextFloat(), random.nextFloat(), random.nextFloat())
      val where = if s.pdf > 0f then part(s.wi.y, s.wi.z) else -1
      addTo(sampled, where, s.weight.g)
    for i <- 0 to 8 do
      val chance = 4.5 * Math.hypot(walked(i).error, sampled(i).error)
      // Beside chance, a thousandth of the power for the tables.
      val off = Math.abs(walked(i).mean - sampled(i).mean)
      assert(off < chance + 1e-3, s"part $i from $wo: ${sampled(i)}, not ${walked(i)}")

  private def part(y: Double, z: Double): Int =
    Math.min((z * 4).toInt, 3) * 2 + (if y > 0 then 1 else 0)

  test("the value under a smooth coat is the closed form, written out"):
    val (wo, wi) = (Directions.at(30, 0), Directions.at(60, 130))
    def through(w: Vec3): Double =
      val cosT = Math.sqrt(1 - (1 - w.z.toDouble * w.z) / 2.25)
      (1 - Fresnel.dielectric(w.z, 1.5f)) * Math.exp(-0.01 / cosT)
    val r = coats.of(TrowbridgeReitz(0f, 0f), 1.5f, 0.01f).internalReflectance.toDouble
    val series = (0 until 5).map(k => 0.5 * Math.pow(0.5 * r, k)).sum
    val expected = through(wo) * through(wi) * series / (Math.PI * 2.25)
    val actual = coated(Rgb.gray(0.5f), 0f, 0f).f(wo, wi).r
    assert(Math.abs(actual - expected) < 1e-5 * expected) // rounding
