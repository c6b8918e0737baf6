package candela.film

import org.scalatest.funsuite.AnyFunSuite

/** What every filter obeys, and the values that the dialects' formulas give. */
class FiltersSuite extends AnyFunSuite:

  private val all = FiltersSuite.all

  test("filters are even and vanish beyond their radii"):
    for (name, filter) <- all; i <- 0 to 60 do
      val (dx, dy) = (filter.radiusX * i / 50, filter.radiusY * i / 50)
      assert(filter(dx, dy) == filter(-dx, dy) && filter(dx, dy) == filter(dx, -dy), name)
      assert(i <= 50 || filter(dx, 0f) == 0f && filter(0f, dy) == 0f, s"$name at $dx, $dy")

  test("a filter is the product of its two functions, largest at the centre"):
    for (name, filter) <- all; i <- 0 to 20; j <- 0 to 20 do
      val (dx, dy) = (filter.radiusX * i / 20, filter.radiusY * j / 20)
      assert(filter(dx, dy) == filter.x(dx) * filter.y(dy))
      assert(Math.abs(filter(dx, dy)) <= filter(0f, 0f), s"$name at $dx, $dy")

  test("sigma and alpha describe the same Gaussians: alpha = 1 / (2 sigma²)"):
    val alpha = GaussianFilter.ofAlpha(1.5f, 2f, 2f)
    val sigma = GaussianFilter.ofSigma(1.5f, 2f, 0.5f)
    for i <- 0 to 40 do assert(alpha(i / 20f, i / 30f) == sigma(i / 20f, i / 30f))
    // exp(−2·0.25) − exp(−2·2.25), worked by hand.
    assert(Math.abs(alpha.x(0.5f) - 0.5954216f) < 1e-6f)

  test("Mitchell's pieces meet, are smooth, and integrate to 1 over radius 2 whatever B and C are"):
    for (b, c) <- Vector((1 / 3f, 1 / 3f), (1f, 0f), (0f, 0.5f), (0.2f, 0.9f)) do
      val filter = MitchellFilter(2f, 2f, b, c)
      val values = (0 until 4000).map(i => filter.x((i + 0.5f) / 1000 - 2f).toDouble)
      // Midpoint rule of step 1e-3 on cubics, in Float: 1e-6 of curvature and 1e-5 of rounding.
      assert(Math.abs(values.sum / 1000 - 1) < 2e-5, s"B $b C $c")
      for edge <- Vector(1f, 2f) do
        val step = 1e-3f
        // Both pieces' slopes are below 3, so values this near differ by less than 6e-3.
        assert(Math.abs(filter.x(edge - step) - filter.x(edge + step)) < 6e-3f)
    assert(Math.abs(MitchellFilter(2f, 2f, 1 / 3f, 1 / 3f).x(0f) - 8 / 9f) < 1e-6f)

  test("v3's and v4's sinc is 0 at whole pixels and at tau; v2's scales with the radius"):
    val sinc = LanczosSincFilter(4f, 4f, 2.5f)
    for zero <- Vector(1f, 2f, 2.5f, 3f) do assert(Math.abs(sinc.x(zero)) < 1e-7f)
    // sinc(1/2) · sinc(1/5) by hand: 0.63661977 · 0.93548928.
    assert(Math.abs(sinc.x(0.5f) - 0.59555097f) < 1e-6f)
    val old = LanczosSincFilter.stretched(4f, 4f, 3f)
    for zero <- Vector(4 / 3f, 8 / 3f, 4f) do assert(Math.abs(old.x(zero)) < 1e-7f)
    // sinc(1/8) · sinc(3/8): 0.97449536 · 0.78421330.
    assert(Math.abs(old.x(0.5f) - 0.76421222f) < 1e-6f)

  test("filters without extent or meaning can't be made"):
    def fails(make: => Any) = intercept[IllegalArgumentException] { val _ = make }
    fails(BoxFilter(0f, 1f))
    fails(TriangleFilter(1f, -1f))
    fails(BoxFilter(Float.NaN, 1f))
    fails(GaussianFilter.ofAlpha(1f, 1f, 0f))
    fails(LanczosSincFilter(1f, 1f, 0f))

object FiltersSuite:
  val all: Vector[(String, Filter)] = Vector(
    "box" -> BoxFilter(0.5f, 0.5f),
    "wide box" -> BoxFilter(1.7f, 0.8f),
    "triangle" -> TriangleFilter(2f, 1.3f),
    "Gaussian" -> GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f),
    "wide Gaussian" -> GaussianFilter.ofAlpha(2f, 3f, 0.4f),
    "Mitchell" -> MitchellFilter(2f, 2f, 1 / 3f, 1 / 3f),
    "Catmull-Rom" -> MitchellFilter(2f, 3f, 0f, 0.5f),
    "sinc" -> LanczosSincFilter(4f, 4f, 3f),
    "stretched sinc" -> LanczosSincFilter.stretched(4f, 2f, 3f)
  )
