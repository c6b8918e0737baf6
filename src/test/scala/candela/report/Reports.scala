package candela.report

import candela.bench.report.{BiasAgainst, ProgramResult, SceneResult, SuiteReport}
import candela.bench.statistics.{MeasuredCurve, Measurement}
import candela.image.Image
import candela.measure.{BiasTest, CurvePoint, Errors, Renderings, TileSums}

/** Reports of nothing that was rendered, with numbers that are easy to find again. */
object Reports:
  val machine: Machine =
    Machine("A <Processor> & Co", 2, 8_000_000_000L, "Linux", "Java", Some(0.1))

  /** A gradient with a value that no screen can show, times `gain`. */
  def picture(gain: Float): Image =
    val image = Image.rgb(24, 16)
    for i <- image.data.indices do image.data(i) = gain * (0.05f + i / 400f)
    image

  val reference: Image = picture(1f)
  val image: Image = picture(1.1f)

  val report: RenderReport = RenderReport(
    "a </script> scene.pbrt",
    "1.2.3",
    machine,
    Vector("seed" -> "5"),
    Vector("integrator" -> "path & more"),
    Some("truth.exr"),
    Vector(1, 4, 16).map(n => CurvePoint(n, 0.5 * n, errors(0.3 / n))) :+
      CurvePoint(64, 32, Errors.against(reference)(image)),
    Vector(Span("parse", 0, 0.25), Span("render", 0.25, 32.25)),
    Vector(PassSpan(1, 0, 0.5, Vector(0.5, 0.4)), PassSpan(4, 0.5, 2, Vector(1.5, 1.2))),
    Vector(Picture("64 samples", image), Picture("reference", reference, isReference = true)),
    123456,
    Vector(LearnedFigure("share", "guided bounces", 0.375, "37.5 %"))
  )

  def errors(mse: Double): Errors =
    Errors(mse, mse, Some(mse), Some(30), Some(mse), Vector(1, 1.01, 0.99))

  /** Of two programs, where one is a tenth brighter and both have noise of 1 %. */
  private def bias: BiasTest =
    def images(gain: Float) = Renderings.seeds(Vector(0.99f, 1f, 1.01f).map: noise =>
      TileSums.of(picture(gain * noise)))
    BiasTest.of(images(1.1f), images(1f))

  val suite: SuiteReport =
    def program(name: String, color: Int, factor: Double) =
      val runs =
        for samples <- Vector(1, 4, 16); seed <- Vector(1, 2, 3)
        yield Measurement(samples, seed, samples * factor, errors((1 + 0.1 * seed) / samples))
      val curve = MeasuredCurve(runs, runs.groupMap(_.samples)(_.seconds))
      ProgramResult(name, s"The $name", color, color == 1, s"$name scene.pbrt", curve, image)
    val scene = SceneResult(
      "box",
      "A box",
      "small",
      reference,
      Some("box.exr"),
      0.2,
      Vector(program("fast", 0, 0.5), program("slow", 1, 2.0)),
      biases = Vector(BiasAgainst("The slow", "The fast", bias))
    )
    SuiteReport(
      "A race",
      "1.2.3",
      machine,
      "2020-01-01",
      60,
      3,
      Vector(scene),
      Vector("pbrt-v9" -> "`pbrt-v9` is not installed")
    )
