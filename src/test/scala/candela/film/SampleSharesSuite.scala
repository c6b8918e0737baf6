package candela.film

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

class SampleSharesSuite extends AnyFunSuite:

  private val filters = Vector(
    BoxFilter(1f, 0.75f),
    TriangleFilter(1f, 2f),
    GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f),
    MitchellFilter(2f, 2f, 1f / 3f, 1f / 3f),
    LanczosSincFilter(4f, 4f, 3f)
  )

  // A film of 6 × 5 pixels at (10, 20), with two tiles side by side and all around
  private val tiles =
    Vector(PixelBounds(6, 16, 12, 29), PixelBounds(12, 16, 20, 29))
  private def shares(filter: Filter) =
    SampleShares(PixelBounds(10, 20, 16, 25), FilterReach(filter), tiles)
  private def image(s: SampleShares): Image =
    Film(PixelBounds(10, 20, 16, 25), shares = Some(s)).toImage(1f)

  /** As many samples along each axis of each pixel, evenly placed. */
  private def fill(s: SampleShares, along: Int)(light: (Float, Float) => Float): Unit =
    for (tile, i) <- tiles.zipWithIndex do
      val pass = s.pass()
      pass.selectTile(i)
      for
        y <- tile.y0 until tile.y1; x <- tile.x0 until tile.x1
        v <- 0 until along; u <- 0 until along
      do
        val px = x + (u + 0.5f) / along
        val py = y + (v + 0.5f) / along
        val value = light(px, py)
        if pass.reaches(px, py) then pass.add(px, py, value, 2f * value, 0.5f)
      pass.end()

  test("a table differs from its filter by less than a thousandth of the peak"):
    for filter <- filters do
      val reach = FilterReach(filter)
      for i <- -500 to 500 do
        val dx = filter.radiusX * i / 500f
        val dy = filter.radiusY * i / 500f
        assert(Math.abs(reach.x(dx) - filter.x(dx)) < 1e-3f * filter.x(0f), s"$filter $dx")
        assert(Math.abs(reach.y(dy) - filter.y(dy)) < 1e-3f * filter.y(0f), s"$filter $dy")
      assert(reach.x(filter.radiusX * 1.01f) == 0f && reach.y(-filter.radiusY * 1.01f) == 0f)

  test("even light stays as it is up to the edges, whatever the filter"):
    for filter <- filters do
      val s = shares(filter)
      fill(s, 3)((_, _) => 0.25f)
      assert(image(s).data.grouped(3).forall(_.sameElements(Array(0.25f, 0.5f, 0.5f))), filter)

  test("samples count as much as their pass"):
    val s = shares(filters.head)
    for (weight, light) <- Vector((1f, 3f), (2f, 0f), (1f, 9f)); i <- tiles.indices do
      val pass = s.pass()
      pass.selectTile(i, weight)
      for y <- 16 until 29; x <- tiles(i).x0 until tiles(i).x1 do
        val (px, py) = (x + 0.5f, y + 0.5f)
        if pass.reaches(px, py) then pass.add(px, py, light, 1f, 0f)
      pass.end()
    assert(image(s).data.grouped(3).forall(_.sameElements(Array(3f, 1f, 0f))))

  test("a pixel is the convolution of the light with the filter"):
    // ∫ of f(d) · (light at the centre + d), by the midpoint rule; light is an edge aslant
    def light(x: Float, y: Float): Float = if x + 0.3f * y > 19.6f then 1f else 0f
    for filter <- filters do
      val s = shares(filter)
      fill(s, 16)(light)
      val got = image(s)
      for y <- 0 until 5; x <- 0 until 6 do
        var sum, all = 0.0
        val steps = 200
        for v <- 0 until steps; u <- 0 until steps do
          val dx = filter.radiusX * ((2 * u + 1f) / steps - 1f)
          val dy = filter.radiusY * ((2 * v + 1f) / steps - 1f)
          val weight = filter(dx, dy)
          sum += weight * light(10.5f + x + dx, 20.5f + y + dy)
          all += weight
        assert(Math.abs(got(x, y, 0) - sum / all) < 0.01, s"$filter at ($x, $y)")

  test("samples count just where the filter reaches the film"):
    val pass = shares(TriangleFilter(1f, 1f)).pass()
    assert(pass.reaches(9.6f, 19.6f) && !pass.reaches(9.4f, 21f) && !pass.reaches(11f, 19.4f))

  test("the sums do not depend on which tile was first"):
    def light(x: Float, y: Float): Float = (x * 12.9898f + y * 78.233f) % 1f
    val orders =
      for order <- Vector(Vector(0, 1), Vector(1, 0)) yield
        val s = shares(GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f))
        val pass = s.pass()
        for i <- order do
          pass.selectTile(i)
          for k <- 0 until 500 do
            val x = (if i == 0 then 10f else 12f) + k * 0.0037f
            val y = 20f + k * 0.0091f
            pass.add(x, y, light(x, y), 1e6f * light(y, x), 1f)
          pass.end()
        image(s).data.toVector
    assert(orders(0) == orders(1))

  test("what was added since a copy is seen alone"):
    val s = shares(TriangleFilter(1f, 1f))
    fill(s, 2)((_, _) => 4f)
    val before = s.copy()
    fill(s, 2)((_, _) => 1f)
    assert(image(before).data.forall(v => v == 4f || v == 8f || v == 0.5f))
    assert(image(s.deltaSince(before)).data.forall(v => v == 1f || v == 2f || v == 0.5f))

  test("filters that stay in the pixel, or are very wide or narrow, are not shared by"):
    assert(!FilterReach.isUseful(BoxFilter(0.5f, 0.5f)))
    assert(FilterReach.isUseful(BoxFilter(0.5f, 0.6f)))
    assert(FilterReach.isUseful(LanczosSincFilter(4f, 4f, 3f)))
    assert(!FilterReach.isUseful(TriangleFilter(1f, 20f)))
    assert(!FilterReach.isUseful(TriangleFilter(0.01f, 2f)))
    assert(!FilterReach.isUseful(GaussianFilter.ofSigma(1.5f, 1.5f, 0.01f)))
