package candela.mlt

import candela.io.{CheckedFile, CheckedInput, CheckedOutput}
import candela.color.Rgb
import candela.film.Splats
import candela.render.TinyPlan

import java.io.EOFException
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** What a chain walks by: its steps must be as likely as their way back, and nothing of a step that
  * was rejected may stay.
  */
final class PrimarySamplesSuite extends AnyFunSuite:
  private def point(s: PrimarySamples, dimensions: Int): Vector[Float] =
    s.camera.rewind()
    Vector.fill(dimensions)(s.camera.next1D())

  test("a rejected step leaves the point as it was, be it large or small"):
    val s = PrimarySamples(largeStep = 0.3f, sigma = 0.02f)
    s.start(7L)
    val before = point(s, 50)
    for step <- 1 to 100 do
      s.propose()
      // Steps may ask for less or more than the point has had
      val tried = Vector.fill(20 + step)(s.camera.next1D())
      assert(tried != before.take(tried.size))
      s.reject()
    assert(point(s, 50) == before)

  test("small steps are small, and keep to the cube"):
    val s = PrimarySamples(largeStep = 0f, sigma = 0.02f)
    s.start(1L)
    var last = point(s, 8)
    var squares = 0.0
    val steps = 4000
    for _ <- 1 to steps do
      s.propose()
      val tried = Vector.fill(8)(s.camera.next1D())
      s.accept()
      for (a, b) <- tried.zip(last) do
        assert(a >= 0f && a < 1f)
        val d = Math.abs(a - b)
        squares += Math.pow(Math.min(d, 1f - d), 2)
      last = tried
    val deviation = Math.sqrt(squares / (8 * steps))
    // 32,000 draws: 0.4 % of standard error
    assert(Math.abs(deviation / 0.02 - 1) < 0.02)

  test("a dimension that was long not asked for has moved as far as by all the steps between"):
    val s = PrimarySamples(largeStep = 0f, sigma = 0.01f)
    var squares = 0.0
    val chains = 4000
    for seed <- 1 to chains do
      s.start(seed.toLong)
      val first = s.camera.next1D()
      for _ <- 1 to 9 do
        s.propose()
        s.accept()
      val d = Math.abs(s.camera.next1D() - first)
      squares += Math.pow(Math.min(d, 1f - d), 2)
    // 1.1 % of standard error
    assert(Math.abs(Math.sqrt(squares / chains) / 0.03 - 1) < 0.06)

  test("after a large step all is new, and uniform"):
    val s = PrimarySamples(largeStep = 1f, sigma = 0.01f)
    s.start(3L)
    val bins = new Array[Int](10)
    for _ <- 1 to 10000 do
      s.propose()
      bins((s.light.next1D() * 10).toInt) += 1
      s.accept()
    // 1,000 in each, ± 30
    assert(bins.forall(n => Math.abs(n - 1000) < 150), bins.mkString(" "))

  test("a chain goes where the target is, by its histogram"):
    // π(x) = 2x over 20 bins, and what follows from one dimension for the mean of another
    val s = PrimarySamples(largeStep = 0.2f, sigma = 0.1f)
    s.start(11L)
    var x = s.camera.next1D()
    val bins = new Array[Int](20)
    val steps = 400000
    for _ <- 1 to steps do
      s.propose()
      val y = s.camera.next1D()
      if s.uniform() * x < y then
        s.accept()
        x = y
      else s.reject()
      bins((x * 20).toInt) += 1
    for i <- 0 until 20 do
      val expected = (2 * i + 1) / 400.0 * steps
      // Steps are correlated over some 10: the error is some 3 √n
      assert(Math.abs(bins(i) - expected) < 18 * Math.sqrt(expected) + 20, s"bin $i: ${bins(i)}")

  /** What is read of a file with these values. */
  private def stored(write: CheckedOutput => Unit)(read: CheckedInput => Unit): Unit =
    val file = Files.createTempFile("candela", ".chain")
    try
      CheckedFile.write(file, "chain")(write)
      CheckedFile.read(file, "chain")(read)
    finally Files.delete(file)

  test("a saved point goes on as it would have"):
    val (s, other) = (PrimarySamples(0.3f, 0.1f), PrimarySamples(0.3f, 0.1f))
    s.start(5L)
    def steps(of: PrimarySamples) =
      for _ <- 1 to 40 yield
        of.propose()
        val at = point(of, 9)
        if at.head < 0.5f then of.accept() else of.reject()
        at
    val _ = steps(s)
    stored(s.save)(other.load)
    assert(steps(s) == steps(other))

  test("a forged point, which no chain can have, is refused"):
    def load(time: Int, lastLarge: Int, known: Int, value: Float, changed: Int): Unit =
      def write(to: CheckedOutput): Unit =
        to.long(1L)
        to.int(time)
        to.int(lastLarge)
        to.float(Float.NaN)
        for n <- Vector(known, 0, 0) do
          to.int(n)
          if n > 0 then
            to.float(value)
            to.int(changed)
      stored(write)(PrimarySamples(0.3f, 0.1f).load)
    load(time = 5, lastLarge = 5, known = 1, value = 0.99f, changed = 5)
    def refused(time: Int = 5, lastLarge: Int = 2, value: Float = 0.5f, changed: Int = -1) =
      intercept[IllegalArgumentException](load(time, lastLarge, 1, value, changed)).getMessage
    assert(refused(lastLarge = 6).endsWith("a chain has step 6 of 5"))
    assert(refused(time = -2, lastLarge = -2).endsWith("a chain has step -2 of -2"))
    for value <- Vector(1f, -0.1f, Float.NaN, Float.PositiveInfinity) do
      assert(refused(value = value).endsWith(s"a random number is $value"))
    for step <- Vector(-2, 6, Int.MaxValue) do
      assert(refused(changed = step).endsWith(s"a step is $step"))
    for known <- Vector(-1, 100, Int.MaxValue) do
      val _ = intercept[EOFException](load(5, 2, known, 0.5f, 1))

  test("the light of a forged path is finite, and its splats are in the file"):
    val view = TinyPlan()((_, _) => Rgb.White).view(Splats.Discarded)
    def load(strength: Float, count: Int): Unit =
      def write(to: CheckedOutput): Unit =
        to.float(strength)
        to.int(count)
        for _ <- 1 to 5 do to.float(1f)
      stored(write)(Contribution(view).load)
    load(0.5f, 1)
    for strength <- Vector(-1f, Float.NaN, Float.PositiveInfinity) do
      val why = intercept[IllegalArgumentException](load(strength, 1)).getMessage
      assert(why.endsWith(s"a path's light is $strength"))
    for count <- Vector(-1, 2, Int.MaxValue) do
      val _ = intercept[EOFException](load(0.5f, count))
