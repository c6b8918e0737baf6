package candela.textures

import candela.color.{MutableRgb, Rgb}
import candela.math.*
import candela.testing.Draws
import org.scalatest.funsuite.AnyFunSuite

class FilteredLookupSuite extends AnyFunSuite:
  private val Size = 64

  private def pyramid(w: Int, h: Int, wrap: Wrap = Wrap.Repeat)(f: (Float, Float) => Float) =
    val values = Array.tabulate(w * h)(i => f((i % w + 0.5f) / w, (i / w + 0.5f) / h))
    Pyramid.of(FloatTexels(w, h, 1, values), wrap, Float.PositiveInfinity)

  private def lookups(levels: Array[MipLevel]): Seq[FilteredLookup] = Seq(
    EwaLookup(MipMap.of(levels), 8f, bottomUp = false, turned = false),
    TrilinearLookup(MipMap.of(levels), 2f, fromSecond = true, bottomUp = false, turned = false),
    TrilinearLookup(MipMap.of(levels), 1f, fromSecond = false, bottomUp = false, turned = false),
    LevelLookup(MipMap.of(levels), interpolates = true, bottomUp = false, turned = false),
    LevelLookup(MipMap.of(levels), interpolates = false, bottomUp = false, turned = false)
  )

  private def footprint(draws: Draws): Seq[Float] =
    val size = draws.magnitude(1e-4, 2)
    Seq.fill(4)(draws.between(-size, size))

  test("a picture of one value has that value, whatever the footprint, size and filter"):
    val draws = Draws(1)
    for
      (w, h) <- Seq((64, 64), (8, 32), (1, 1), (5, 3), (37, 1))
      wrap <- Seq(Wrap.Repeat, Wrap.Clamp)
    do
      val levels = pyramid(w, h, wrap)((_, _) => 0.7f)
      for lookup <- lookups(levels); _ <- 0 until 100 do
        val Seq(a, b, c, d) = footprint(draws): @unchecked
        val v = lookup.filtered(draws.between(-2, 2), draws.between(-2, 2), a, b, c, d).r
        // Sums of up to a few hundred Floats
        assert(abs(v - 0.7f) < 1e-5f, s"$w×$h, $wrap, ${lookup.getClass}: $v")

  test("far out and where the place is no number, a picture of one value has it, too"):
    val wild = Seq(1e10f, -1e10f, 1e30f, -1e30f, Float.PositiveInfinity, Float.NaN, 0.3f)
    for
      wrap <- Seq(Wrap.Repeat, Wrap.Clamp)
      lookup <- lookups(pyramid(Size, Size, wrap)((_, _) => 0.7f))
      s <- wild
      t <- wild
    do
      val v = lookup.filtered(s, t, 0.03f, 0f, 0f, 0.03f).r
      assert(abs(v - 0.7f) < 1e-5f, s"$wrap, ${lookup.getClass}, at ($s, $t): $v")

  test("a footprint as large as a texel of a level gives the mean of what that texel covers"):
    val levels = pyramid(Size, Size)((s, t) => (s * 977 % 1) * (t * 331 % 1))
    val lookup =
      TrilinearLookup(MipMap.of(levels), 1f, fromSecond = false, bottomUp = false, turned = false)
    for k <- 1 to 6; x <- 0 until Size / (1 << k) by 3 do
      val n = 1 << k
      val texels = for j <- 0 until n; i <- x * n until (x + 1) * n yield levels(0)(j * Size + i, 0)
      val extent = n.toFloat / Size
      val v = lookup.filtered((x + 0.5f) * extent, 0.5f * extent, extent, 0f, 0f, 0f).r
      assert(abs(v - texels.sum / texels.size) < 1e-5f, s"level $k")

  test("an elliptical average is the Gaussian integral over the footprint"):
    val draws = Draws(2)
    def wave(s: Float, t: Float) = cos(TwoPi * (2 * s + 3 * t))
    val level = pyramid(Size, Size)(wave)(0)
    for _ <- 0 until 200 do
      // Radii of 6 to 13 texels: one more, by which the ellipse is widened, is 1 % of the longest
      val (length, angle) = (draws.between(0.1f, 0.2f), draws.between(0, TwoPi))
      val width = draws.between(0.1f, 0.2f)
      val (ax, ay) = (length * cos(angle), length * sin(angle))
      val (bx, by) = (-width * sin(angle), width * cos(angle))
      val (s, t) = (draws.unit(), draws.unit())
      val average = MutableRgb()
      EwaLookup.addAverage(level, s, t, ax, ay, bx, by, 1f, average)
      val v = average.r
      var (sum, weights) = (0.0, 0.0)
      for i <- -20 to 20; j <- -20 to 20 do
        val (x, y) = (i / 20f, j / 20f)
        val r2 = x * x + y * y
        if r2 < 1 then
          val weight = Math.exp(-2 * r2) - Math.exp(-2)
          sum += weight * wave(s + x * ax + y * bx, t + x * ay + y * by)
          weights += weight
      assert(abs(v - (sum / weights).toFloat) < 0.02f, s"$length × $width at $angle")

  test("an elliptical average follows the ellipse's direction"):
    // Stripes: along them nothing is blurred, across them all is
    val stripes = pyramid(Size, Size)((s, t) => if (s + t) * 8 % 2 < 1 then 1f else 0f)
    val ewa = EwaLookup(MipMap.of(stripes), 64f, bottomUp = false, turned = false)
    val (l, w) = (0.15f, 0.005f)
    val along = ewa.filtered(0.53f, 0.53f, l, -l, w, w).r
    val across = ewa.filtered(0.53f, 0.53f, l, l, w, -w).r
    assert(along > 0.99f)
    assert(abs(across - 0.5f) < 0.15f)

  test("an ellipse that is too long is widened, not shortened"):
    val draws = Draws(3)
    val levels = pyramid(Size, Size)((_, _) => draws.unit())
    val narrow = EwaLookup(MipMap.of(levels), 4f, bottomUp = false, turned = false)
    val wide = EwaLookup(MipMap.of(levels), 1e9f, bottomUp = false, turned = false)
    for _ <- 0 until 100 do
      val (s, t) = (draws.unit(), draws.unit())
      val expected = wide.filtered(s, t, 0.4f, 0f, 0f, 0.1f).r
      assert(abs(narrow.filtered(s, t, 0.4f, 0f, 0f, 0.01f).r - expected) < 1e-5f)

  test("without a footprint the finest level is read bilinearly"):
    val draws = Draws(4)
    val levels = pyramid(Size, 16)((_, _) => draws.unit())
    for lookup <- lookups(levels).init; _ <- 0 until 50 do
      val (s, t) = (draws.between(-1, 2), draws.between(-1, 2))
      assert(lookup.filtered(s, t, 0f, 0f, 0f, 0f) == levels(0).bilinear(s, t))

  test("enlarging to a power of two keeps constants and the place of a step"):
    val levels = pyramid(12, 5, Wrap.Clamp)((s, _) => if s < 0.5f then 0f else 1f)
    assert(levels(0).width == 16 && levels(0).height == 8)
    def value(x: Int) = levels(0)(3 * 16 + x, 0)
    assert((0 until 6).forall(x => abs(value(x)) < 1e-5f))
    assert((10 until 16).forall(x => abs(value(x) - 1) < 1e-5f))
    assert(value(7) < 0.5f && value(8) > 0.5f)

  test("three channels are filtered as one is"):
    val draws = Draws(5)
    val values = Array.fill(16 * 16 * 3)(draws.unit())
    val rgb = Pyramid.of(FloatTexels(16, 16, 3, values), Wrap.Repeat, 1f)
    val single = (0 until 3).map: c =>
      val texels = FloatTexels(16, 16, 1, Array.tabulate(256)(i => values(3 * i + c)))
      Pyramid.of(texels, Wrap.Repeat, 1f)
    for i <- 0 until 5; _ <- 0 until 50 do
      val Seq(a, b, c, d) = footprint(draws): @unchecked
      val (s, t) = (draws.unit(), draws.unit())
      val parts = single.map(levels => lookups(levels)(i).filtered(s, t, a, b, c, d).r)
      assert(lookups(rgb)(i).filtered(s, t, a, b, c, d) == Rgb(parts(0), parts(1), parts(2)))
