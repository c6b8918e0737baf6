package candela.textures

import candela.base.loop
import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite

import candela.math.clamp
import candela.render.ThreadPool
import candela.testing.Draws

class PyramidSuite extends AnyFunSuite:

  private def numbers(texels: Texels): Seq[Float] =
    for i <- 0 until texels.width * texels.height; c <- 0 until texels.channels yield texels(i, c)

  /** Windowed sinc over four texels: Lanczos, "Applied Analysis", 1956. */
  private def weight(x: Double): Double =
    def sinc(x: Double) = if Math.abs(x) < 1e-5 then 1 else Math.sin(Math.PI * x) / (Math.PI * x)
    if Math.abs(x) > 1 then 0 else sinc(x) * sinc(2 * x)

  /** The obvious way to one value: four by four texels around, each by its weights, in Double. */
  private def value(from: Texels, wrap: Wrap, w: Int, h: Int, x: Int, y: Int, c: Int): Double =
    def taps(at: Int, old: Int, now: Int) =
      val centre = (at + 0.5) * old / now
      val first = Math.floor(centre - 1.5).toInt
      val raw = (0 until 4).map(k => weight((first + k + 0.5 - centre) / 2))
      (0 until 4).map(k => (first + k, raw(k) / raw.sum))
    val all =
      for (j, b) <- taps(y, from.height, h); (i, a) <- taps(x, from.width, w) yield
        // First across, so it wraps across first
        val across = wrap.index(i, 0, from.width, from.height)
        val down = wrap.index(0, j, from.width, from.height)
        if across < 0 || down < 0 then 0.0 else a * b * from(across + down, c)
    clamp(all.sum.toFloat, 0f, 1f)

  test("an enlarged picture is what the obvious way makes of it"):
    val draws = Draws(4)
    for (w, h) <- Seq((37, 20), (5, 64), (128, 3)); wrap <- Seq(Wrap.Repeat, Wrap.Black, Wrap.Clamp)
    do
      val from = FloatTexels(w, h, 3, Array.fill(3 * w * h)(draws.unit()))
      val large = Pyramid.enlarged(from, wrap, 1f)
      for _ <- 0 until 200 do
        val (x, y, c) = (draws.below(large.width), draws.below(large.height), draws.below(3))
        val expected = value(from, wrap, large.width, large.height, x, y, c)
        // Sums of sixteen Floats of about 1
        assert(Math.abs(large(y * large.width + x, c) - expected) < 3e-6, s"$w×$h, $wrap, $x $y")

  test("a picture whose sides are powers of two stays as it is"):
    val texels = FloatTexels(4, 2, 1, Array.fill(8)(2f))
    assert(Pyramid.enlarged(texels, Wrap.Repeat, 1f) eq texels)

  test("a low picture is enlarged by many threads as by one"):
    val draws = Draws(5)
    for wrap <- WrapSuite.All; height <- Seq(1, 3, 5) do
      val from = FloatTexels(9000, height, 1, Array.fill(9000 * height)(draws.unit()))
      val alone = numbers(Pyramid.enlarged(from, wrap, 1f))
      assert(numbers(Pyramid.enlarged(from, wrap, 1f, ThreadPool(3))) == alone, s"$height, $wrap")

  test("all wraps are the same with any number of threads"):
    val draws = Draws(8)
    for wrap <- WrapSuite.All; channels <- Seq(1, 3) do
      val size = 150
      val from = FloatTexels(size, size, channels, Array.fill(channels * size * size)(draws.unit()))
      def all(parallel: Parallel) = Pyramid.levels(from, wrap, 1f, parallel)
      val alone = all(Parallel.Alone)
      val together = all(ThreadPool(3))
      assert(alone.length == together.length)
      loop(alone.length): k =>
        val same = numbers(alone(k)) == numbers(together(k))
        if !same then fail(s"level $k, $wrap")
