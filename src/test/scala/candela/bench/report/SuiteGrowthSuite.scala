package candela.bench.report

import candela.bench.statistics.{MeasuredCurve, Measurement}
import candela.report.Reports

import org.scalatest.funsuite.AnyFunSuite

class SuiteGrowthSuite extends AnyFunSuite:

  /** Scenes of one program, whose time and memory are those of the start and of each thing. */
  private def scenes(of: String, sizes: Int*)(time: Int => Double, bytes: Int => Double) =
    for size <- sizes.toVector yield
      val runs =
        for seed <- Vector(1, 2, 3)
        yield Measurement(
          1,
          seed,
          time(size) + 0.001 * (seed - 2),
          Reports.errors(0.1),
          Some(bytes(size).toLong)
        )
      val program = ProgramResult(
        "fast",
        "The fast",
        0,
        false,
        "fast scene.pbrt",
        MeasuredCurve(runs, runs.groupMap(_.samples)(_.seconds)),
        Reports.image
      )
      SceneResult(
        s"$of-$size",
        s"$size $of",
        "",
        Reports.reference,
        None,
        0.2,
        Vector(program),
        growth = Some(Growth(of, size))
      )

  private val spheres =
    scenes("spheres", 1_000_000, 100, 10_000, 1000)(1 + 1e-5 * _, 1e8 + 250.0 * _)
  private val quadratic =
    scenes("knots", 1000, 10_000, 100_000)(n => 1e-9 * n * n, n => 2e8 + 100.0 * n)
  private val report = Reports.suite.copy(scenes = spheres ++ Reports.suite.scenes ++ quadratic)

  test("sizes rise, whatever the order of the suite"):
    val Vector(first, second) = report.growing: @unchecked
    assert((first.quantity, second.quantity) == ("spheres", "knots"))
    assert(first.seconds("fast").map(_._1) == Vector(100.0, 1000.0, 10_000.0, 1_000_000.0))
    assert(first.seconds("slow").isEmpty)

  test("exponents are those of the largest sizes, where the start weighs little"):
    val Vector(first, second) = report.growing: @unchecked
    assert(Math.abs(GrowingScenes.exponent(second.seconds("fast")).get - 2) < 1e-9)
    val time = GrowingScenes.exponent(first.seconds("fast")).get
    assert(time > 0.2 && time < 1)
    assert(GrowingScenes.exponent(first.seconds("fast").take(1)).isEmpty)
    assert(Math.abs(GrowingScenes.marginal(first.memory("fast")).get - 250) < 1)
    assert(GrowingScenes.marginal(first.memory("fast").take(1)).isEmpty)

  test("what grows faster than in proportion is marked"):
    val second = report.growing(1)
    assert(GrowthPart.exponentWords(second.seconds("fast")) == "2.00 ▲")
    assert(!GrowthPart.exponentWords(second.memory("fast")).contains("▲"))

  test("a page has both charts of each, and errors of the other scenes only"):
    val page = SuitePage.html(report)
    for words <- Vector("Time by spheres", "Memory by spheres", "Time by knots", "2.00 ▲") do
      assert(page.contains(words), words)
    assert(page.contains("<h2>A box</h2>") && !page.contains("<h2>1000 knots</h2>"))
    assert(!SuitePage.html(Reports.suite).contains("<h2>Growth</h2>"))
    val grown = SuitePage.html(report.copy(scenes = spheres))
    assert(!grown.contains("Time to target") && grown.contains("<h2>Method</h2>"))

  test("an .svg shows time and memory side by side"):
    val svg = SuiteChart.svg(report)
    for words <- Vector("spheres: seconds", "spheres: MB", "knots: seconds") do
      assert(svg.contains(words), words)

  test("JSON has what grows"):
    val scenes = ujson.read(SuiteData.json(report))("scenes").arr
    assert(scenes(0)("grows")("of").str == "spheres" && scenes(0)("grows")("size").num == 1e6)
    assert(scenes.exists(_("grows").isNull))
