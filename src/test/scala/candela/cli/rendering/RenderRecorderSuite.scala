package candela.cli.rendering

import candela.color.Rgb
import candela.film.{Development, Film}
import candela.image.Image
import candela.measure.LogLogFit
import candela.render.{Looks, Pass, RenderControl, RenderListener, RenderPlan, Renderer, TinyPlan}

import org.scalatest.funsuite.AnyFunSuite

/** Curves of an integrand whose variance is known: uniform numbers have variance 1/12. */
class RenderRecorderSuite extends AnyFunSuite:
  private val plan: RenderPlan = TinyPlan(width = 40, height = 30, spp = 48): (_, sampler) =>
    Rgb(sampler.next1D(), 2 * sampler.next1D(), 3 * sampler.next1D())

  /** Means of r, 2r and 3r; their variances are 1, 4 and 9 times 1/12. */
  private val variance = (1 + 4 + 9) / 3.0 / 12

  private def truth: Image =
    val image = Image.rgb(40, 30)
    for i <- image.data.indices do image.data(i) = 0.5f * (i % 3 + 1)
    image

  /** Of 3600 squares, of which the blue ones rule: 1200 with a deviation of about √2 each give 4 %
    * of the mean; five times that.
    */
  private val tolerance = 0.2

  private def recorded(reference: Option[Image], threads: Int = 2): RenderRecorder =
    val recorder = RenderRecorder(Development(), reference)
    val _ = Renderer.render(plan, RenderControl(threads, listener = recorder))
    recorder

  test("against the truth, the error is variance / samples at every point"):
    val recorder = recorded(Some(truth))
    assert(recorder.points.map(_.samples) == Vector(1, 2, 4, 8, 16, 32, 48))
    for p <- recorder.points do
      assert(Math.abs(p.errors.mse / (variance / p.samples) - 1) < tolerance, p.samples)
      // 1200 pixels: 0.29 / √1200 is 0.8 % of a mean of 0.5
      assert(p.errors.meanRatio.forall(r => Math.abs(r - 1) < 0.09 / Math.sqrt(p.samples)))
    val slope = LogLogFit.slope(recorder.points.map(p => (p.samples.toDouble, p.errors.mse)))
    assert(Math.abs(slope.get + 1) < 0.06)

  test("without the truth, the estimate from two parts of the samples is the same"):
    val recorder = recorded(None)
    // One sample has no parts; the last parts, 32 and 16, are unequal.
    assert(recorder.points.map(_.samples) == Vector(2, 4, 8, 16, 32, 48))
    for p <- recorder.points do
      assert(Math.abs(p.errors.mse / (variance / p.samples) - 1) < tolerance, p.samples)
      assert(p.errors.meanRatio.isEmpty && p.errors.flip.isEmpty)

  test("halves after a killed rendering begin where all pixels have equally many samples"):
    val recorder = RenderRecorder(Development(), None)
    val uneven = new RenderListener:
      override def frequency: Looks = recorder.frequency
      override def begins(samples: Int, maxSamples: Int, film: Film): Unit =
        recorder.begins(3, 13, film)
      override def passed(pass: Pass, film: Film): Unit = recorder.passed(pass, film)
    val _ = Renderer.render(plan, RenderControl(2, listener = uneven))
    assert(recorder.points.map(_.samples) == Vector(32, 48))

  test("time goes on from pass to pass, and every worker has its own"):
    val passes = recorded(None).passes
    assert(passes.map(_.samples) == Vector(1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48))
    assert(passes.forall(p => p.workers.size == 2 && p.workers.forall(_ <= p.end - p.begin)))
    assert(passes.zip(passes.tail).forall((a, b) => a.end <= b.begin))

  test("pictures are the image as it became, its first pass, and the reference"):
    val recorder = recorded(Some(truth))
    assert(recorder.pictures.map(_.name) == Vector("48 samples", "1 sample", "reference"))
    val plain = Renderer.render(plan, 2).film.toImage(1f)
    assert(recorder.pictures.head.image.data.sameElements(plain.data))
