package candela.guiding

import candela.math.*
import candela.sampling.IndependentSampler

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Paths of two events in a world of two directions. */
class GuidePathSuite extends AnyFunSuite:
  import GuidePathSuite.*

  test("guided paths know the second moment of unguided ones", Slow):
    val measured = unguidedMoment(shareOfBright = 0.6)
    // The same path by its own second moment, where nothing is guided
    val direct = ownMoment(shareOfBright = Bsdf)
    assert(Math.abs(measured / exact(Bsdf) - 1) < 0.03)
    assert(Math.abs(direct / exact(Bsdf) - 1) < 0.03)
    assert(Math.abs(ownMoment(shareOfBright = 0.6) / exact(0.6) - 1) < 0.03)
    assert(exact(0.6) < 0.6 * exact(Bsdf))

  test("paths with branches know the second moment of those without, and what they cost", Slow):
    val measured = unguidedMoment(shareOfBright = 0.6, branches = 3)
    assert(Math.abs(measured / exact(Bsdf) - 1) < 0.03)
    assert(ownMoment(shareOfBright = Bsdf, branches = 3) < 0.9 * exact(Bsdf))
    val records = recorded(shareOfBright = 0.6, branches = 3)
    // The camera's ray, two at the first event, and two at the event of each branch
    assert(records.pathCost == 1 + 2 + 2 * 3)
    assert(Math.abs(records.costs(FirstRegion) - (1 + 2 * 3)) < 1e-5)
    assert(Math.abs(records.costs(SecondRegion) - 1) < 1e-5)

  test("sky found by the first direction counts a quarter of it in unguided paths"):
    def unguided(arrives: Boolean): Float =
      val (path, records) = (GuidePath(), GuideRecords(1f, regions = 6))
      val part = records.newPart()
      path.clear()
      path.add(FirstRegion, Vec3.Zero, 0, Vec3(0f, 0f, 1f), 1f, 1f, 1f, 1f, 1f, 1f)
      if arrives then path.step()
      path.record(3f, part)
      records.sorted().numbers(GuideRecords.Unguided)
    // The light before it, squared, and its product with the other count in full
    assert(unguided(arrives = true) == 1f + 2f * 2f + 4f)
    assert(unguided(arrives = false) == 1f + 2f * 2f + 4f / 4)

  test("directions that the BSDF would hardly sample have finite moments"):
    for later <- Vector(0f, 2f) do
      val (path, records) = (GuidePath(), GuideRecords(1f, regions = 6))
      val part = records.newPart()
      path.clear()
      def event(before: Float, ratio: Float) =
        path.add(FirstRegion, Vec3.Zero, 0, Vec3(0f, 0f, 1f), before, 1f, 1f, 1e-30f, 1f, ratio)
      event(before = 1f, ratio = 1f)
      event(before = 3f, ratio = Float.PositiveInfinity)
      path.record(3f + later, part)
      val unguided = records.sorted().numbers(GuideRecords.Unguided)
      assert(if later == 0f then unguided == 9f else unguided == Float.MaxValue, unguided)

private object GuidePathSuite:
  import GuideRecords.{Size, Total, Unguided}

  /** Probability of the bright direction by BSDF sampling; both events have it. */
  val Bsdf = 0.1
  val Paths = 400000

  val FirstRegion = 2
  val SecondRegion = 5

  /** Light found before the first event, after it, and after the second. Dim directions find some,
    * so that every path is recorded.
    */
  private def light(first: Boolean, second: Boolean): (Double, Double, Double) =
    (0.2, if first then 1.0 else 0.1, (if first then 1.0 else 0.2) * (if second then 3.0 else 0.1))

  private def probability(isBright: Boolean, ofBright: Double): Double =
    if isBright then ofBright else 1 - ofBright

  /** Second moment of the light where the bright direction is taken with this probability. */
  def exact(ofBright: Double): Double =
    val all =
      for a <- Vector(false, true); b <- Vector(false, true)
      yield
        val (p1, p2) = (probability(a, ofBright), probability(b, ofBright))
        val (q1, q2) = (probability(a, Bsdf), probability(b, Bsdf))
        val (before, after, last) = light(a, b)
        val sum = before + after * q1 / p1 + last * q1 * q2 / (p1 * p2)
        p1 * p2 * sum * sum
    all.sum

  private def mean(shareOfBright: Double, branches: Int)(
      of: (Array[Float], Int) => Double
  ): Double =
    val all = recorded(shareOfBright, branches).sorted()
    (0 until all.count).map(i => of(all.numbers, i * Size)).sum / Paths

  /** Paths whose first event is followed by several branches. */
  def recorded(shareOfBright: Double, branches: Int): GuideRecords =
    val sampler = IndependentSampler(Paths, 3)
    val (path, records) = (GuidePath(), GuideRecords(1f, regions = 6))
    val part = records.newPart()
    for i <- 0 until Paths do
      sampler.start(0, 0, i)
      sampler.next2D()
      val a = sampler.x < shareOfBright
      val (p1, q1) = (probability(a, shareOfBright), probability(a, Bsdf))
      val (before, after, _) = light(a, second = false)
      val first = q1 / p1
      path.clear()
      path.step()
      event(path, FirstRegion, before, 1.0, p1, q1, p1 / q1)
      part.countEvent(FirstRegion)
      val place = path.lastEvent
      var found = before + after * first
      for _ <- 0 until branches do
        val b = sampler.next1D() < shareOfBright
        val (p2, q2) = (probability(b, shareOfBright), probability(b, Bsdf))
        val share = first / branches
        path.follow(place, found.toFloat)
        path.step()
        event(path, SecondRegion, found, share, p2, q2, p1 * p2 / (q1 * q2) * branches)
        part.countEvent(SecondRegion)
        found += light(a, b)._3 * share * q2 / p2
      path.record(found.toFloat, part)
    records

  private def event(
      path: GuidePath,
      region: Int,
      before: Double,
      throughput: Double,
      p: Double,
      q: Double,
      ratio: Double
  ): Unit =
    val up = Vec3(0f, 0f, 1f)
    path.add(
      region, Vec3.Zero, GuideField.side(up), up, before.toFloat, throughput.toFloat, p.toFloat,
      q.toFloat, 0f, ratio.toFloat
    )

  def unguidedMoment(shareOfBright: Double, branches: Int = 1): Double =
    mean(shareOfBright, branches)((all, at) => all(at + Unguided))

  def ownMoment(shareOfBright: Double, branches: Int = 1): Double =
    mean(shareOfBright, branches)((all, at) => all(at + Total).toDouble * all(at + Total))
