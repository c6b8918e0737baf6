package candela.bsdf.measured

import candela.bsdf.{BsdfLaws, Directions}
import candela.color.Rgb
import candela.math.*
import candela.testing.Draws

class MeasuredReflectionSuite extends BsdfLaws:
  private val draws = Draws(5)

  /** A made-up material, measured at random pairs of directions: the same for swapped ones. */
  private def truth(p: Vec3): Float = 0.1f + 0.05f * p.z + 0.02f * p.x * (1f - p.y)

  private val pairs = Vector.fill(3000):
    def up() = Directions.at(draws.between(0f, 85f).toDouble, draws.between(0f, 360f).toDouble)
    ScatteredReflection.pair(up(), up())

  private val scattered = ScatteredReflection(
    pairs.flatMap(p => Seq(p.x, p.y, p.z)).toArray,
    pairs.flatMap(p => Seq(truth(p), 0.5f * truth(p), 0f)).toArray
  )

  private val constant =
    HalfAngleReflection(Array.fill(3 * 90 * 90 * 180)(0.2f))

  obeysLaws("a constant table", constant)

  test("near measurements, the value is theirs"):
    for _ <- 0 until 2000 do
      val wo = Directions.at(draws.between(0f, 80f).toDouble, draws.between(0f, 360f).toDouble)
      val wi = Directions.at(draws.between(0f, 80f).toDouble, draws.between(0f, 360f).toDouble)
      val p = ScatteredReflection.pair(wo, wi)
      val found = scattered.f(wo, wi)
      // the truth changes by at most 0.07 over the cube, by 0.02 over the widest radius in use
      assert(abs(found.r - truth(p)) < 0.02f, s"$wo $wi: ${found.r}, not ${truth(p)}")
      assert(abs(found.g - 0.5f * found.r) < 1e-6f && found.b == 0f)

  test("the mean is that of a search through all measurements"):
    for _ <- 0 until 300 do
      val (wo, wi) = (draws.above(Vec3.Z), draws.above(Vec3.Z))
      val x = ScatteredReflection.pair(wo, wi)
      def distance2(p: Vec3) = (p - x).lengthSquared
      val radius2 = Iterator
        .iterate(0.001f)(_ * 2f)
        .find(r => r > 1.5f || pairs.count(distance2(_) < r) > 2)
        .get
      val near = pairs.filter(distance2(_) < radius2)
      val weights = near.map(p => Math.exp(-100.0 * distance2(p)))
      val expected = near.zip(weights).map((p, w) => w * truth(p)).sum / weights.sum
      // weights in Float, of which a measurement at the radius' edge may be in or out
      assert(Math.abs(scattered.f(wo, wi).r - expected) < 1e-3, s"$wo $wi")

  test("swapped or turned directions are the same pair"):
    for _ <- 0 until 1000 do
      val (wo, wi) = (draws.above(Vec3.Z), draws.above(Vec3.Z))
      val p = ScatteredReflection.pair(wo, wi)
      assert((p - ScatteredReflection.pair(wi, wo)).length < 1e-6f)
      assert(p.x >= 0f && p.x <= 1f && p.y >= 0f && p.y <= 1f && p.z >= 0f && p.z <= 1f)

  test("the table is read by half angle, and by the light's angles around it"):
    val values = new Array[Float](3 * 90 * 90 * 180)
    // Only the row of the highlight itself: half angles up to 90°/90² = 0.011°
    for i <- 0 until 3 * 90 * 180 do values(i) = 1f
    val table = HalfAngleReflection(values)
    val wo = Directions.at(40, 30)
    assert(table.f(wo, Vec3(-wo.x, -wo.y, wo.z)).r == 1f)
    assert(table.f(wo, Directions.at(41, 210)).r == 0f)
    assert(table.f(wo, wo).r == 0f)

  test("a table looks the same from below"):
    val table = HalfAngleReflection(Array.tabulate(3 * 90 * 90 * 180)(i => (i / 3 % 97).toFloat))
    for _ <- 0 until 200 do
      val (wo, wi) = (draws.above(Vec3.Z), draws.above(Vec3.Z))
      assert(table.f(wo, wi) == table.f(-wo, -wi))
