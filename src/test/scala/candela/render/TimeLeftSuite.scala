package candela.render

import candela.film.PixelBounds

import org.scalatest.funsuite.AnyFunSuite

/** Renderings by a virtual clock. */
class TimeLeftSuite extends AnyFunSuite:
  import TimeLeftSuite.*

  test("a steady rendering is foretold, but not in the first seconds"):
    val course = Course(spp = 64, (_, _) => 1.0)
    assert(Math.abs(course.total - 64) <= 0.1)
    assert(course.left(1.5).isEmpty && course.left(2.5).isDefined)
    for part <- Vector(0.1, 0.25, 0.5, 0.9) do course.assertNear(part, 0.01)

  test("a slow start is forgotten"):
    // The first seconds are up to six times slower
    val course = Course(spp = 512, (_, seconds) => 0.2 * (1 + 5 * Math.exp(-seconds / 1.5)))
    course.assertNear(0.1, 0.03)
    for part <- Vector(0.25, 0.5) do course.assertNear(part, 0.01)

  test("what precedes the first samples is no part of their pace"):
    val course = Course(spp = 64, (_, _) => 1.0, before = 30)
    course.assertNear(0.5, 0.01)

  test("pixels of unequal cost are foretold to an eighth"):
    // An empty sky at the top, glass at the bottom
    for spp <- Vector(16, 64, 300) do
      val course = Course(spp, (place, _) => if place < 0.5 then 0.2 else 3.0)
      for part <- Vector(0.12, 0.25, 0.4, 0.5, 0.75, 0.9) do course.assertNear(part, 0.13)

  test("of a rendering whose machine gets busy, what is left follows the new pace"):
    val course = Course(spp = 256, (_, seconds) => if seconds < 64 then 1.0 else 2.0)
    // From 192 s on, the last half is all at half the pace
    course.assertNear(200.0 / course.total, 0.02)

  test("a rendering that is continued has only its new samples left"):
    val course = Course(spp = 64, (_, _) => 1.0, earlier = 32)
    course.assertNear(0.5, 0.01)

  test("an error ends it at the samples that it needs, at most those that are planned"):
    def found(samples: SampleRange) = Course(4096).by(ExpectedEnd(None, true, Some(samples)))
    val near = found(SampleRange(96, 64, 128))
    assert(near.samples.contains(SampleRange(96, 64, 128)))
    assert(near.left.exists(isNear(76)))
    val far = found(SampleRange(6000, 3000, Int.MaxValue))
    assert(far.samples.contains(SampleRange(4096, 3000, 4096)))

  test("while nobody knows when an error is reached, the samples that are planned are no end"):
    def unknown(time: Option[Double]) = Course(4096).by(ExpectedEnd(time, true, None))
    assert(unknown(None).samples.isEmpty && unknown(None).left.isEmpty && unknown(None).hasGoal)
    // A time ends it in any case
    assert(unknown(Some(60)).left.exists(isNear(40)))

  test("of a time and a number of samples, the first one ends it"):
    def timed(spp: Int) = Course(spp).by(ExpectedEnd(Some(60), false, None))
    assert(timed(4096).left.exists(isNear(40)) && timed(4096).samples.isEmpty)
    assert(timed(40).left.exists(isNear(20)))

  test("the rate is that of the last half of the samples"):
    val course = Course(spp = 512, (_, seconds) => if seconds < 10 then 1.0 else 0.1)
    assert(Math.abs(course.at(50).rate.get / Pixels - 10) < 0.1)

private object TimeLeftSuite:
  private val Pixels = 64 * 64

  private def isNear(expected: Double)(seconds: Double) = Math.abs(seconds - expected) < 0.2

  /** A rendering that is looked at ten times a second.
    *
    * @param cost    seconds per sample of all pixels, by the place in the image, from 0 to 1, and
    *   the seconds so far
    * @param before  seconds that precede the first sample
    * @param earlier samples per pixel of the rendering that it continues
    */
  final class Course(
      spp: Int,
      cost: (Double, Double) => Double = (_, _) => 1.0,
      before: Double = 0,
      earlier: Int = 0
  ):
    private val schedule = TileSchedule(PixelBounds(0, 0, 64, 64), spp)
    private val Steps = 200

    /** Samples taken, and seconds. */
    private val looks: Vector[(Long, Double)] =
      val found = Vector.newBuilder[(Long, Double)]
      found += ((0L, before))
      var seconds = before
      for wave <- 0 until schedule.waves if schedule.firstSample(wave) >= earlier do
        val first = schedule.firstSample(wave) - earlier
        val size = schedule.endSample(wave) - schedule.firstSample(wave)
        for step <- 0 until Steps do
          val previous = seconds
          seconds += size * cost((step + 0.5) / Steps, seconds) / Steps
          // A look in between sees what was done before
          if Math.floor(seconds * 10) > Math.floor(previous * 10) then
            found += (((first + size * (step + 1.0) / Steps) * Pixels).toLong -> seconds)
      found.result()
    val total: Double = looks.last._2

    /** What is told after so many seconds. */
    def at(seconds: Double, goal: Option[ExpectedEnd] = None): Outlook =
      val ends = goal
      val rule = new StoppingRule:
        override def expectedEnd: Option[ExpectedEnd] = ends
      val timeLeft = TimeLeft(schedule, Pixels, earlier, rule, rule)
      looks.takeWhile(_._2 <= seconds + 1e-6)
        .map((done, s) => timeLeft.outlook(done, spp, s, s)).last

    def left(seconds: Double): Option[Double] = at(seconds).left

    /** What is told of a goal after twenty seconds. */
    def by(goal: ExpectedEnd): Outlook = at(20, Some(goal))

    /** What is expected at a part of the time is right up to a part of the whole time. */
    def assertNear(part: Double, tolerance: Double): Unit =
      val seconds = part * total
      val all = seconds + left(seconds).getOrElse(fail(seconds))
      assert(Math.abs(all / total - 1) <= tolerance, s"at $part of $total s: $all s")

    private def fail(seconds: Double) = throw AssertionError(s"nothing is known at $seconds s")
