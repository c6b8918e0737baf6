package candela.bidirectional

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
