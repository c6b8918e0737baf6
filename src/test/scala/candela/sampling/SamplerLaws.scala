package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

/** What every sampler must obey; a new sampler's suite extends it and adds its own promises.
  *
  * @param make    a sampler of at least so many samples per pixel with this seed
  * @param sharper by what factor at least the error of a smooth integral must shrink from 16 to 256
  *                samples; for independent samples it is √16 = 4
  */
abstract class SamplerLaws(make: (Int, Int) => Sampler, sharper: Double) extends AnyFunSuite:
  protected type Point = (Float, Float)

  /** The points of one pair of dimensions, after `skip` earlier requests for pairs. */
  protected def points(s: Sampler, px: Int, py: Int, count: Int, skip: Int): IndexedSeq[Point] =
    (0 until count).map: i =>
      s.start(px, py, i)
      for _ <- 0 to skip do s.next2D()
      (s.x, s.y)

  protected def singles(s: Sampler, px: Int, py: Int, count: Int, skip: Int): IndexedSeq[Float] =
    (0 until count).map: i =>
      s.start(px, py, i)
      for _ <- 0 until skip do s.next1D(): Unit
      s.next1D()

  test("numbers are in [0, 1)"):
    val s = make(64, 3)
    for px <- 0 until 4; py <- 0 until 4; i <- 0 until s.samplesPerPixel do
      s.start(px, py, i)
      for _ <- 0 until 100 do
        s.next2D()
        val u = s.next1D()
        assert(Seq(s.x, s.y, u).forall(v => v >= 0f && v < 1f))

  test("it offers at least the samples asked for"):
    for n <- Seq(1, 2, 3, 4, 16, 100) do assert(make(n, 0).samplesPerPixel >= n)

  test("samples beyond those asked for are new ones, and as evenly spread"):
    val s = make(16, 3)
    val all = points(s, 5, 7, 64 * s.samplesPerPixel, 0)
    assert(all.distinct.size == all.size)
    // 1024 of them, or more: three standard deviations of independent ones
    for mean <- Vector(all.map(_._1).sum / all.size, all.map(_._2).sum / all.size) do
      assert(Math.abs(mean - 0.5) < 0.03)

  test("a number depends on pixel, sample, dimension and seed, not on what was asked before"):
    val (a, b) = (make(16, 5), make(16, 5))
    for px <- 0 until 5; i <- 0 until 16 do // b goes elsewhere first
      b.start(9 - px, 3, 15 - i)
      b.next2D()
      b.start(px, 2, i)
      a.start(px, 2, i)
      for _ <- 0 until 8 do
        a.next2D()
        b.next2D()
        assert(a.x == b.x && a.y == b.y && a.next1D() == b.next1D())

  test("a copy goes its own way and gives the same numbers"):
    val a = make(16, 5)
    a.start(1, 2, 3)
    val b = a.copy()
    b.start(1, 2, 3)
    assert((0 until 20).map(_ => a.next1D()) == (0 until 20).map(_ => b.next1D()))
    assert(a.samplesPerPixel == b.samplesPerPixel)

  test("after skipTo come the numbers that follow so many requests, for pairs, too"):
    val (a, b) = (make(16, 5), make(16, 5))
    for skip <- Seq(0, 1, 8, 21) do
      a.start(1, 2, 3)
      for _ <- 0 until skip do a.next1D(): Unit
      b.start(1, 2, 3)
      for _ <- 0 until 30 do b.next2D()
      b.skipTo(skip)
      a.next2D()
      b.next2D()
      assert(a.x == b.x && a.y == b.y && a.next1D() == b.next1D(), s"after $skip")

  test("after goTo come the numbers that followed there"):
    val sampler = make(16, 5)
    for skip <- Seq(0, 1, 8, 21) do
      sampler.start(1, 2, 3)
      for _ <- 0 until skip do sampler.next1D(): Unit
      val position = sampler.position
      val next = sampler.next1D()
      for _ <- 0 until 30 do sampler.next2D()
      sampler.goTo(position)
      assert(sampler.next1D() == next, s"after $skip")

  test("a number that does not matter takes up its dimension"):
    val (a, b) = (make(16, 5), make(16, 5))
    for before <- Seq(0, 1, 8, 21) do
      for s <- Seq(a, b) do
        s.start(1, 2, 3)
        for _ <- 0 until before do s.next1D(): Unit
      assert(a.next1D(matters = true) != 0f)
      assert(b.next1D(matters = false) == 0f)
      a.next2D(matters = true)
      b.next2D(matters = false)
      a.next2D()
      b.next2D()
      assert(a.x == b.x && a.y == b.y && a.next1D() == b.next1D(), s"after $before")

  test("another seed gives other numbers"):
    assert(points(make(16, 1), 0, 0, 16, 0) != points(make(16, 2), 0, 0, 16, 0))

  private def correlation(a: IndexedSeq[Float], b: IndexedSeq[Float]): Double =
    a.indices.map(i => (a(i) - 0.5) * (b(i) - 0.5) * 12).sum / a.size

  // Independent uniform numbers, times √12: products have mean 0 and variance 1, so the mean of
  // 4096 has a deviation of 1/64; 5 of those.
  private val Uncorrelated = 5.0 / 64

  test("pixels are decorrelated"):
    val s = make(16, 7)
    for skip <- 0 until 3; (dx, dy) <- Seq((1, 0), (0, 1), (5, 3)) do
      val places = for px <- 0 until 64; py <- 0 until 64 yield (px, py)
      val here = places.map((px, py) => singles(s, px, py, 1, skip).head)
      val there = places.map((px, py) => singles(s, px + dx, py + dy, 1, skip).head)
      // an image-wide sequence repels neighbours on purpose; what it must not do is repeat them
      val c = correlation(here, there)
      assert(c < Uncorrelated && c > -0.5, s"skip $skip, offset $dx $dy: $c")

  test("dimensions are decorrelated"):
    val s = make(16, 7)
    val numbers = // pixel and sample, then dimension
      for px <- 0 until 16; py <- 0 until 16; i <- 0 until 16 yield
        s.start(px, py, i)
        s.next2D()
        val pair = Seq(s.x, s.y)
        pair ++ Seq.fill(6)(s.next1D())
    for d <- 0 until 8; e <- 0 until d do
      val c = correlation(numbers.map(_(d)), numbers.map(_(e)))
      assert(Math.abs(c) < Uncorrelated, s"dimensions $d and $e: $c")

  /** The root mean square error, over pixels and seeds, of ∫∫ f at a number of samples. (Image-wide
    * sequences scramble all pixels alike: seeds are what is independent.)
    */
  protected def error(samples: Int, skip: Int)(
      f: (Double, Double) => Double,
      exact: Double
  ): Double =
    val squares =
      for seed <- 0 until 64; px <- 0 until 2 yield
        val s = make(samples, seed)
        val n = s.samplesPerPixel
        val py = seed % 8
        val mean = points(s, px, py, n, skip).map((x, y) => f(x, y)).sum / n
        (mean - exact) * (mean - exact)
    Math.sqrt(squares.sum / squares.size)

  test("the error of a smooth integral falls as fast as it should"):
    // e^(x + y/2) has ∫∫ = (e − 1) · 2(√e − 1)
    val exact = (Math.E - 1) * 2 * (Math.sqrt(Math.E) - 1)
    def e(n: Int, skip: Int) = error(n, skip)((x, y) => Math.exp(x + y / 2), exact)
    for skip <- Seq(0, 1, 5) do
      val gain = e(16, skip) / e(256, skip)
      assert(gain > sharper, s"after $skip pairs: $gain")
