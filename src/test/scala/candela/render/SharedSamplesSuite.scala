package candela.render

import candela.color.Rgb
import candela.film.{Film, Filter, GaussianFilter, PixelBounds, TriangleFilter}
import candela.image.Image
import candela.sampling.Sampler

import org.scalatest.funsuite.AnyFunSuite

class SharedSamplesSuite extends AnyFunSuite:

  private val noise: (Where, Sampler) => Rgb = (_, sampler) =>
    Rgb(sampler.next1D(), sampler.next1D() * 1e-6f, sampler.next1D() * 1e6f)

  private def plan(
      shares: Boolean,
      filter: Filter = TriangleFilter(1f, 1f),
      crop: Option[PixelBounds] = None,
      spp: Int = 11
  )(radiance: (Where, Sampler) => Rgb) =
    TinyPlan(50, 37, spp, crop, filter = filter, sharesSamples = shares)(radiance)

  private def red(image: Image): Vector[Double] =
    image.data.toVector.grouped(3).map(_.head.toDouble).toVector

  test("the image is the same, bit for bit, whatever the number of threads, seen or not"):
    val shared = plan(shares = true)(noise)
    val one = Renderer.render(shared, threads = 1).film.toImage(1f).data.toVector
    object Eye extends RenderListener:
      override def frequency: Looks = Looks.Doublings
      override def passed(pass: Pass, film: Film): Unit =
        val _ = film.toImage(1f)
    for threads <- Vector(2, 3, 7); eye <- Vector(RenderListener.Silent, Eye) do
      val many = Renderer.render(shared, RenderControl(threads, listener = eye))
      assert(many.film.toImage(1f).data.toVector == one, s"$threads threads")
      assert(many.isComplete)

  test("independent noise has the variance that sums of squared weights promise"):
    // (∫f² / (∫f)²)² of a triangle is 4/9; samples of one pixel each: 1/12 over their number
    val spp = 64
    def variance(shares: Boolean): Double =
      val values = red(Renderer.render(plan(shares, spp = spp)(noise), 2).film.toImage(1f))
      values.map(v => (v - 0.5) * (v - 0.5)).sum / values.size * 12 * spp
    assert(Math.abs(variance(shares = false) - 1) < 0.1) // 1,850 pixels: ± 0.033
    assert(Math.abs(variance(shares = true) - 4.0 / 9) < 0.07) // fewer independent ones
    assert(Math.abs(TriangleFilter(1f, 1f).correlation - 9.0 / 4) < 1e-3)

  test("a window is cut from the whole image, its edges included"):
    val window = PixelBounds(9, 4, 29, 23)
    for filter <- Vector(TriangleFilter(1f, 1f), GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f)) do
      val whole = Renderer.render(plan(shares = true, filter)(noise), 2).film.toImage(1f)
      val part =
        Renderer.render(plan(shares = true, filter, Some(window))(noise), 3).film.toImage(1f)
      for y <- 0 until 19; x <- 0 until 20; c <- 0 until 3 do
        // Tiles begin elsewhere, so that sums of Doubles are rounded elsewhere
        assert(Math.abs(part(x, y, c) / whole(x + 9, y + 4, c) - 1f) < 1e-6f)

  test("at the edges light from beyond the image counts, as the filter has it"):
    // Beyond the left edge it is bright: of a triangle of radius 1 an eighth of the area is there
    val edge = plan(shares = true, spp = 256): (where, _) =>
      Rgb.gray(if where.x < 0 then 8f else 0f)
    val image = Renderer.render(edge, 2).film.toImage(1f)
    val first = (0 until 37).map(image(0, _, 0).toDouble).sum / 37
    assert(Math.abs(first - 1) < 0.02)
    assert(image(1, 5, 0) == 0f && image(49, 5, 0) == 0f)

  test("samples that are NaN are left out, and the first is named"):
    val bad = plan(shares = true): (where, _) =>
      if where == Where(20, 20, 3) || where == Where(39, 20, 3) then Rgb(Float.NaN, 0f, 0f)
      else Rgb(0.5f, 0.25f, 2f)
    for threads <- 1 to 3 do
      val rendering = Renderer.render(bad, threads)
      val image = rendering.film.toImage(1f)
      assert(image.data.grouped(3).forall(_.sameElements(Array(0.5f, 0.25f, 2f))))
      assert(rendering.discarded.contains(DiscardedSamples(2, x = 20, y = 20, sample = 3)))

  test("a cancelled rendering is the mean of what there is"):
    val cancellation = Cancellation()
    val endless = plan(shares = true, spp = 1000): (where, _) =>
      if where.sample == 8 then cancellation.request()
      Rgb(0.5f, 0.25f, 2f)
    val rendering = Renderer.render(endless, RenderControl(threads = 2, cancellation))
    assert(!rendering.isComplete && rendering.samplesDone <= 8)
    val image = rendering.film.toImage(1f)
    assert(image.data.grouped(3).forall(_.sameElements(Array(0.5f, 0.25f, 2f))))
