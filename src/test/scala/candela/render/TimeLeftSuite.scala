package candela.render

import candela.film.PixelBounds

import org.scalatest.funsuite.AnyFunSuite

/** Renderings by a virtual clock. */
class TimeLeftSuite extends AnyFunSuite:
  import TimeLeftSuite.*

  test("a steady rendering is foretold, but not in the first seconds"):
    val course = Course(spp = 64, (_, _) => 1.0)
    // Looks are 0.1 s apart, which is 1.6 % of the first 6.4 s
    assert(Math.abs(course.total - 64) <= 0.1)
    assert(course.foretold(1.5).isEmpty && course.foretold(2.5).isDefined)
    for part <- Vector(0.1, 0.25, 0.5, 0.9) do course.assertNear(part, 0.02)

  test("a slow start is forgotten"):
    // The first seconds are up to six times slower
    val course = Course(spp = 512, (_, seconds) => 0.2 * (1 + 5 * Math.exp(-seconds / 1.5)))
    course.assertNear(0.1, 0.1)
    for part <- Vector(0.25, 0.5) do course.assertNear(part, 0.03)

  test("a JVM that still compiles gets faster, and the interval says how uncertain that is"):
    val course = Course(spp = 64, (_, _) => 1.0)
    def range(seconds: Double, warm: Double) = course.range(seconds, Some(warm)).get
    def width(r: TimeRange) = r.high / r.low
    // On a busy machine 20 s may be 3 s of a processor
    assert(range(20, 3).expected < 0.75 * range(20, Warm).expected)
    assert(width(range(20, 3)) > 2 && width(range(20, Warm)) < 1.3)
    assert(!range(3, 3).isKnown(3) && range(20, Warm).isKnown(20))
    assert(course.range(20, Some(1.5)).isEmpty)

  test("an interval of samples is one of the time"):
    val course = Course(spp = 200, (_, _) => 1.0)
    val found = course.until(SampleRange(100, 80, Int.MaxValue), 50)
    assert(Math.abs(found.expected - 50) < 2 && found.low < 31 && found.high.isInfinite)
    assert(!found.isKnown(50) && !found.says(50))
    assert(course.until(SampleRange(100, 80, 130), 50).says(50))

  test("pixels of unequal cost are compared with themselves"):
    // An empty sky at the top, glass at the bottom
    val cost = (place: Double, _: Double) => if place < 0.5 then 0.2 else 3.0
    for spp <- Vector(16, 64) do
      val course = Course(spp, cost)
      for part <- Vector(0.25, 0.5, 0.75) do course.assertNear(part, 0.05)

  test("in the first sweep over the image the pixels so far stand for all"):
    val course = Course(spp = 1, (_, _) => 60)
    // Steps of 0.3 s, 4 % of the first 7.2 s
    for part <- Vector(0.12, 0.25, 0.5) do course.assertNear(part, 0.05)

  test("of a rendering whose machine gets busy, what is left is told by the new pace"):
    val course = Course(spp = 256, (_, seconds) => if seconds < 64 then 1.0 else 2.0)
    // Half the pace, from 64 s on: 128 s and 256 s remain at the two places
    assert(Math.abs(course.foretold(64).get - 192) < 8)
    assert(Math.abs(course.foretold(192).get - (course.total - 192)) < 15)

  test("what a pass prepares before its samples counts for all passes"):
    // Photons: as long as the samples
    val course = Course(spp = 100, (place, _) => if place < 0.02 then 26 else 0.5, largest = 1)
    for part <- Vector(0.1, 0.25, 0.5) do course.assertNear(part, 0.06)

  test("samples until an error are as many as its waves have"):
    val schedule = TileSchedule(PixelBounds(0, 0, 64, 64), RenderPlan.Endless)
    assert(Vector(0.5, 1.0, 5.2, 33.0, 64.0, 65.0, 1000.0).map(schedule.wholeWaves) ==
      Vector(1, 1, 6, 48, 64, 96, 1024))
    assert(schedule.wholeWaves(1e300) == Int.MaxValue)

  test("the rate is that of the latest samples"):
    val course = Course(spp = 512, (_, seconds) => if seconds < 10 then 1.0 else 0.1)
    assert(Math.abs(course.rate(50).get - 10) < 0.5)

private object TimeLeftSuite:
  /** Seconds after which nothing is compiled any more. */
  val Warm = 1e6

  /** A rendering.
    *
    * @param cost seconds per sample of all pixels, by the place in the image, from 0 to 1, and the
    *   seconds so far
    */
  final class Course(spp: Int, cost: (Double, Double) => Double, largest: Int = 64):
    private val schedule = TileSchedule(PixelBounds(0, 0, 64, 64), spp, largest)
    private val Steps = 200

    /** Ten looks a second: samples per pixel, and seconds. */
    private val looks: Vector[(Double, Double)] =
      val found = Vector.newBuilder[(Double, Double)]
      var seconds = 0.0
      for wave <- 0 until schedule.waves do
        val first = schedule.firstSample(wave)
        val size = schedule.endSample(wave) - first
        for step <- 0 until Steps do
          val before = seconds
          seconds += size * cost((step + 0.5) / Steps, seconds) / Steps
          // A look in between sees what was done before
          if Math.floor(seconds * 10) > Math.floor(before * 10) then
            found += ((first + size * (step + 1.0) / Steps, seconds))
      found.result()
    val total: Double = looks.last._2

    private def after(seconds: Double): TimeLeft =
      val left = TimeLeft()
      for (samples, at) <- looks if at <= seconds + 1e-6 do
        val wave = schedule.waveOf(Math.min(samples, spp - 1e-6).toInt)
        left.add(samples, TimeLeft.Sweep(schedule.firstSample(wave), schedule.endSample(wave)), at)
      left

    /** Seconds left, as expected at some time. */
    def foretold(seconds: Double): Option[Double] = range(seconds, Some(Warm)).map(_.expected)

    /** With its interval.
      *
      * @param warm seconds that the JVM had to compile, if it is not done
      */
    def range(seconds: Double, warm: Option[Double]): Option[TimeRange] =
      after(seconds).until(SampleRange(spp, spp, spp), seconds, warm)

    def until(samples: SampleRange, seconds: Double): TimeRange =
      after(seconds).until(samples, seconds, Some(Warm)).get

    def rate(seconds: Double): Option[Double] = after(seconds).rate

    /** What is expected at a part of the time is right up to a part of the whole time. */
    def assertNear(part: Double, tolerance: Double): Unit =
      val at = part * total
      val all = at + foretold(at).getOrElse(throw AssertionError(s"nothing is known at $at s"))
      assert(Math.abs(all / total - 1) <= tolerance, s"at $part of $total s: $all s")
