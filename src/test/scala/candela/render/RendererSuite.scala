package candela.render

import candela.diagnostics.{Code, Problem, SceneError}
import candela.color.Rgb
import candela.film.{Film, PixelBounds, SampleLimit}
import candela.image.Image

import java.util.concurrent.ConcurrentHashMap

import org.scalatest.funsuite.AnyFunSuite

class RendererSuite extends AnyFunSuite:

  // Powers of two, so that weighted means are exact.
  private val gray = Rgb(0.5f, 0.25f, 2f)

  private def pixel(image: Image, x: Int, y: Int): Rgb =
    Rgb(image(x, y, 0), image(x, y, 1), image(x, y, 2))

  private def pixels(image: Image): Vector[Rgb] =
    (for y <- 0 until image.height; x <- 0 until image.width yield pixel(image, x, y)).toVector

  test("constant radiance gives exactly that in every pixel"):
    val rendering = Renderer.render(TinyPlan()((_, _) => gray), threads = 2)
    assert(pixels(rendering.film.toImage(1f)).forall(_ == gray))
    assert(rendering.isComplete)
    assert(rendering.samplesDone == 5)
    assert(rendering.samplesTaken == 40L * 27 * 5)
    assert(rendering.rays == rendering.samplesTaken)
    assert(rendering.discarded.isEmpty)

  test("the image is the same, bit for bit, whatever the number of threads"):
    val plan = TinyPlan(width = 50, height = 37, spp = 11): (_, sampler) =>
      Rgb(sampler.next1D(), sampler.next1D() * 1e-6f, sampler.next1D() * 1e6f)
    val one = Renderer.render(plan, threads = 1).film.toImage(1f).data.toVector
    assert(one.distinct.size > 3 * 37 * 49, "the radiance must differ nearly everywhere")
    for threads <- Vector(2, 3, 7) do
      val many = Renderer.render(plan, threads).film.toImage(1f).data.toVector
      assert(many == one, s"$threads threads")

  test("every sample of every pixel is taken exactly once"):
    val seen = ConcurrentHashMap[Where, Integer]()
    val plan = TinyPlan(width = 35, height = 18, spp = 7): (where, _) =>
      val _ = seen.merge(where, 1, Integer.sum)
      gray
    val _ = Renderer.render(plan, threads = 3)
    assert(seen.size == 35 * 18 * 7)
    assert(seen.values.stream.allMatch(_ == 1))

  test("of a cropped image only the window is rendered, with the coordinates of the whole"):
    val window = PixelBounds(9, 4, 29, 23)
    val plan = TinyPlan(crop = Some(window)): (where, _) =>
      Rgb(where.x.toFloat, where.y.toFloat, 0f)
    val image = Renderer.render(plan, threads = 2).film.toImage(1f)
    assert((image.width, image.height) == (20, 19))
    assert(pixel(image, 0, 0) == Rgb(9f, 4f, 0f))
    assert(pixel(image, 19, 18) == Rgb(28f, 22f, 0f))

  test("a pixel is the mean of its samples"):
    val plan = TinyPlan(spp = 8)((where, _) => Rgb(where.sample.toFloat, 0f, 1f))
    val image = Renderer.render(plan, threads = 2).film.toImage(1f)
    assert(pixels(image).forall(_ == Rgb(3.5f, 0f, 1f)))

  test("samples above the limit are scaled down to it, and keep their hue"):
    // The largest component, as measures go that are the components themselves
    val limit = SampleLimit(4f, Array(1f, 0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f))
    val plan = TinyPlan(limit = Some(limit)): (where, _) =>
      if where.x == 3 then Rgb(16f, 8f, 0f) else Rgb(4f, 1f, 0f)
    val image = Renderer.render(plan, threads = 1).film.toImage(1f)
    assert(pixel(image, 3, 0) == Rgb(4f, 2f, 0f))
    assert(pixel(image, 4, 0) == Rgb(4f, 1f, 0f))

  test("samples that are NaN or infinite are left out, and the first is named"):
    val plan = TinyPlan(): (where, _) =>
      where match
        case Where(20, 20, 3) => Rgb(Float.NaN, 0f, 0f)
        case Where(30, 2, 4) => Rgb(0f, Float.PositiveInfinity, 0f)
        case Where(39, 20, 3) => Rgb(0f, 0f, Float.NegativeInfinity)
        case _ => gray
    for threads <- 1 to 3 do
      val rendering = Renderer.render(plan, threads)
      assert(pixels(rendering.film.toImage(1f)).forall(_ == gray))
      assert(rendering.discarded.contains(DiscardedSamples(3, x = 20, y = 20, sample = 3)))

  test("a sample that fails stops the rendering, which then names pixel, sample and cause"):
    val bug = ArithmeticException("planted")
    val plan = TinyPlan(spp = 100_000_000): (where, _) =>
      if where == Where(21, 9, 2) then throw bug else gray
    for threads <- 1 to 3 do
      val failure = intercept[RenderFailure](Renderer.render(plan, threads))
      assert((failure.x, failure.y, failure.sample) == (21, 9, 2))
      assert(failure.getCause eq bug)

  test("a file of the scene that can't be read any more ends the rendering as it is"):
    val problem = Problem.general(Code.DamagedImage, "planted")
    val plan = TinyPlan(spp = 100_000_000): (where, _) =>
      if where == Where(21, 9, 2) then throw SceneError(problem) else gray
    for threads <- 1 to 3 do
      assert(intercept[SceneError](Renderer.render(plan, threads)).problems == Vector(problem))

  test("a cancelled rendering keeps the samples that every pixel has"):
    val cancellation = Cancellation()
    val plan = TinyPlan(spp = 1000): (where, _) =>
      if where.sample == 8 then cancellation.request()
      gray
    val rendering = Renderer.render(plan, RenderControl(threads = 1, cancellation))
    assert(!rendering.isComplete)
    assert(rendering.samplesDone == 8)
    assert(rendering.samplesPerPixel == 1000)
    assert(pixels(rendering.film.toImage(1f)).forall(_ == gray))

  test("several workers stop on cancellation, even when there is work for years"):
    val cancellation = Cancellation()
    val plan = TinyPlan(spp = 1_000_000_000): (where, _) =>
      if where.sample == 4 then cancellation.request()
      gray
    val rendering = Renderer.render(plan, RenderControl(threads = 3, cancellation))
    // Samples 0 to 3 are earlier waves; of those another worker may have had something unfinished.
    assert(rendering.samplesDone <= 4)
    assert(rendering.samplesTaken < 40L * 27 * 16)

  test("a rendering that is cancelled before it begins takes no sample"):
    val cancellation = Cancellation()
    cancellation.request()
    val rendering =
      Renderer.render(TinyPlan()((_, _) => gray), RenderControl(threads = 2, cancellation))
    assert(rendering.samplesTaken == 0)
    assert(rendering.samplesDone == 0)
    assert(pixels(rendering.film.toImage(1f)).forall(_.isBlack))

  test("progress never falls, and ends with everything done"):
    val reports = Vector.newBuilder[Progress]
    val plan = TinyPlan()((_, _) => gray)
    val _ = Renderer.render(
      plan,
      RenderControl(
        threads = 2,
        listener = RenderListener.onProgress(p => reports += p: Unit)
      )
    )
    val done = reports.result().map(_.done)
    assert(done == done.sorted)
    assert(reports.result().forall(_.total == 40L * 27 * 5))
    assert(done.last == 40L * 27 * 5)

  test("a failing report of progress stops the workers and is passed on"):
    val plan = TinyPlan(spp = 1_000_000_000)((_, _) => gray)
    val failure = intercept[IllegalStateException]:
      val broken =
        RenderListener.onProgress(p => throw IllegalStateException(s"broken ${p.total}"))
      Renderer.render(plan, RenderControl(2, listener = broken))
    assert(failure.getMessage == s"broken ${40L * 27 * 1_000_000_000}")

  test("an observer of passes sees whole passes, and the image is the same, bit for bit"):
    val plan = TinyPlan(width = 50, height = 37, spp = 11): (_, sampler) =>
      Rgb(sampler.next1D(), sampler.next1D() * 1e-6f, sampler.next1D() * 1e6f)
    val plain = Renderer.render(plan, threads = 2)
    for threads <- 1 to 3 do
      val seen = Vector.newBuilder[(Int, Vector[Float])]
      object Eye extends RenderListener:
        override def frequency: Looks = Looks.Doublings
        override def passed(pass: Pass, film: Film): Unit =
          val _ = seen += pass.samples -> film.toImage(1f).data.toVector
      val watched = Renderer.render(plan, RenderControl(threads, listener = Eye))
      assert(watched.film.toImage(1f).data.sameElements(plain.film.toImage(1f).data))
      assert(watched.samplesTaken == plain.samplesTaken && watched.isComplete)
      assert(seen.result().map(_._1) == Vector(1, 2, 4, 8, 11))
      assert(seen.result().last._2 == plain.film.toImage(1f).data.toVector)

  test("an observer is told when the rendering is to end at once"):
    val cancellation = Cancellation()
    val told = Vector.newBuilder[Boolean]
    object Eye extends RenderListener:
      override def frequency: Looks = Looks.Doublings
      override def passed(pass: Pass, film: Film): Unit =
        told += pass.isStopped()
        if pass.samples == 2 then cancellation.request()
        told += pass.isStopped(): Unit
    val _ = Renderer.render(
      TinyPlan(spp = 8)((_, _) => gray),
      RenderControl(2, cancellation, listener = Eye)
    )
    assert(told.result() == Vector(false, false, false, true))

  test("a pass that was cancelled is not shown"):
    val cancellation = Cancellation()
    val plan = TinyPlan(spp = 1000): (where, _) =>
      if where.sample == 5 then cancellation.request()
      gray
    val samples = Vector.newBuilder[Int]
    object Eye extends RenderListener:
      override def frequency: Looks = Looks.Doublings
      override def passed(pass: Pass, film: Film): Unit =
        val _ = samples += pass.samples
    val rendering = Renderer.render(plan, RenderControl(2, cancellation, listener = Eye))
    assert(samples.result() == Vector(1, 2, 4))
    assert(rendering.samplesDone == 4)
