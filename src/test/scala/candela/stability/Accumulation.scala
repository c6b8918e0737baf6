package candela.stability

import candela.color.Rgb
import candela.film.*
import candela.render.{Renderer, TinyPlan}
import candela.testing.Draws
import Checks.assert

/** Sums of many samples of very different sizes. */
object Accumulation extends Group(
      Seq(
        Case("a pixel of samples over twelve orders has their mean", 200000, 100_000_000L)(
          Sums.twelveOrders
        ),
        Case("a million equal samples have the same mean as one", 1000000, 1_000_000_000L)(
          Sums.equal
        ),
        Case("a rendered pixel of a million samples has their mean", 1000000, 1_000_000_000L)(
          Sums.rendered
        ),
        Case("filters with negative lobes keep what is constant", 100000, 100_000_000L)(
          Sums.negativeLobes
        ),
        Case("what is no number never gets into a sum", 20000, 10_000_000L)(Sums.noNumbers),
        Case("crops and threads change no bit of a pixel", 3, 100L)(Sums.crops)
      )
    )

class AccumulationSuite extends GroupSuite(Accumulation)

private object Sums:
  private def onePixel(): Film = Film(PixelBounds(0, 0, 1, 1))

  /** Doubles add 10⁶ terms with a relative error of 10⁶ · 2⁻⁵³, far below the rounding to Float at
    * the end: the exact mean, added here with a compensated sum (Neumaier, 1974), is met to 1 ulp.
    */
  def twelveOrders(count: Long): Unit =
    val draws = Draws(1)
    val film = onePixel()
    var (sum, lost) = (0.0, 0.0)
    var i = 0L
    while i < count do
      val x = draws.magnitude(1e-6, 1e6)
      film.add(0, 0, x, x, x, 1f)
      val next = sum + x
      lost += (if Math.abs(sum) >= x then (sum - next) + x else (x - next) + sum)
      sum = next
      i += 1
    val exact = ((sum + lost) / count.toDouble).toFloat
    val found = film.toImage(1f).data(0)
    assert(Math.abs(found - exact) <= Math.ulp(exact), s"$found, not $exact"): Unit

  def equal(count: Long): Unit =
    val film = onePixel()
    var i = 0L
    while i < count do
      film.add(0, 0, 0.1f, 1e-30f, 1e30f, 0.7f)
      i += 1
    val data = film.toImage(1f).data
    for (found, exact) <- data.zip(Seq(0.1f, 1e-30f, 1e30f)) do
      assert(Math.abs(found - exact) <= Math.ulp(exact), s"$found, not $exact"): Unit

  /** Through the renderer: what is the same each time, what is 0 or 2, and what is tiny. */
  def rendered(count: Long): Unit =
    val plan = TinyPlan(width = 1, height = 1, spp = count.toInt): (_, sampler) =>
      Rgb(1f, if sampler.next1D() < 0.5f then 2f else 0f, 1e-12f)
    val data = Renderer.render(plan, threads = 2).film.toImage(1f).data
    assert(data(0) == 1f && Math.abs(data(2) - 1e-12f) <= Math.ulp(1e-12f), s"${data.toSeq}")
    // 4.5 standard errors of 1
    assert(Math.abs(data(1) - 1) < 4.5 / Math.sqrt(count.toDouble), s"${data(1)}")

  def negativeLobes(count: Long): Unit =
    val filters = Seq(
      MitchellFilter(2f, 2f, 1f / 3, 1f / 3),
      MitchellFilter(2f, 2f, 0f, 1f),
      LanczosSincFilter(4f, 4f, 3f)
    )
    for filter <- filters do
      val sampler = new FilterSampler(filter)
      val draws = Draws(2)
      val film = onePixel()
      var weights = 0.0
      var i = 0L
      while i < count do
        sampler.sample(draws.unit(), draws.unit())
        film.add(0, 0, 0.25f, 1e6f, 1e-6f, sampler.weight)
        weights += sampler.weight
        i += 1
      // The weights' mean is 1; each is about ±1, so this is 4.5 standard errors
      assert(Math.abs(weights / count - 1) < 9 / Math.sqrt(count.toDouble), s"${weights / count}")
      val data = film.toImage(1f).data
      for (found, exact) <- data.zip(Seq(0.25f, 1e6f, 1e-6f)) do
        assert(Math.abs(found - exact) <= 2 * Math.ulp(exact), s"$found, not $exact"): Unit

  def noNumbers(count: Long): Unit =
    val odd = Seq(Float.NaN, Float.PositiveInfinity, Float.NegativeInfinity)
    val draws = Draws(3)
    var refused = 0L
    val plan = TinyPlan(width = 1, height = 1, spp = count.toInt): (_, _) =>
      val v = Array(1f, 1f, 1f)
      if draws.below(3) == 0 then
        v(draws.below(3)) = odd(draws.below(3))
        refused += 1
      Rgb(v(0), v(1), v(2))
    val rendering = Renderer.render(plan, threads = 1)
    assert(rendering.discarded.map(_.count).contains(refused))
    assert(rendering.film.toImage(1f).data.forall(_ == 1f)): Unit

  def crops(count: Long): Unit =
    def shade(x: Int, y: Int, s: Int) = Rgb(x + 0.1f * s, 1e-7f * y, 1e7f / (1 + x + y + s))
    def plan(crop: Option[PixelBounds]) =
      TinyPlan(width = 70, height = 50, spp = 20, crop = crop): (where, _) =>
        shade(where.x, where.y, where.sample)
    val whole = Renderer.render(plan(None), threads = 1).film.toImage(1f)
    val draws = Draws(4)
    var i = 0L
    while i < count do
      val (x0, y0) = (draws.below(60), draws.below(40))
      val crop = PixelBounds(x0, y0, x0 + 1 + draws.below(70 - x0), y0 + 1 + draws.below(50 - y0))
      val threads = 1 + draws.below(4)
      val part = Renderer.render(plan(Some(crop)), threads).film.toImage(1f)
      for y <- 0 until crop.height; x <- 0 until crop.width; c <- 0 until 3 do
        val there = whole.data(3 * ((y0 + y) * 70 + x0 + x) + c)
        assert(part.data(3 * (y * crop.width + x) + c) == there, s"$crop $threads"): Unit
      i += 1
