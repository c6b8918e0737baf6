package candela.report

import candela.bench.report.{SuiteData, SuitePage}
import candela.measure.Interval

import org.scalatest.funsuite.AnyFunSuite

class PagesSuite extends AnyFunSuite:
  private lazy val pages =
    Vector("rendering" -> RenderPage.html(Reports.report), "suite" -> SuitePage.html(Reports.suite))

  test("pages need nothing but themselves"):
    for (name, page) <- pages do
      // The name of the language of vector graphics is no address that is fetched.
      val addresses = """https?://[^\s"'<]+""".r.findAllIn(page).toSet
      assert(addresses == Set("http://www.w3.org/2000/svg"), name)
      // Pictures are within the page
      val bare = page.replace("<link rel=\"icon\" href=\"data:,\"", "")
        .replace("src=\"data:image/png;base64,", "")
      for word <- Vector("src=", "<link", "@import", "url(") do assert(!bare.contains(word), name)

  test("names can't break a page"):
    val page = pages.head._2
    assert(page.contains("a &lt;/script&gt; scene.pbrt"))
    assert(!page.contains("a </script> scene"))
    assert(page.contains("A &lt;Processor&gt; &amp; Co") && page.contains("path &amp; more"))

  test("a page about a rendering has its figures, timeline, plan and machine"):
    val page = pages.head._2
    for word <-
        Vector("64 samples", "thread 2", "parse", "truth.exr", "integrator", "Java", "37.5 %")
    do
      assert(page.contains(word), word)
    // The chart of each metric, against both axes.
    for metric <- Vector("error", "mse", "mae", "flip"); axis <- Vector("seconds", "samples") do
      assert(page.contains(s"""data-chart="$metric" data-axis="$axis""""), s"$metric $axis")

  test("a page about a suite names who is first, and what was left out"):
    val page = pages(1)._2
    assert(page.contains("pbrt-v9") && page.contains("is not installed"))
    // Error 0.2 on the mean curve 1.2 / samples at 6 samples, half a second each.
    assert(page.contains("""<td class="best">3.000 s</td>"""))
    assert(page.contains("Bias against The fast") && page.contains("p-values of The slow"))
    // After 8 s, the longest run of the first and the second of the other
    assert(page.contains("""<td>8.000</td><td class="best">0.07500</td><td>0.3000</td>"""))

  test("an estimated error is shown with its limits, or with the lower one alone"):
    def report(high: Double) =
      val interval = Interval(0.3, 0.25, high)
      val point = Reports.report.points.head.copy(interval = Some(interval))
      Reports.report.copy(reference = None, points = Vector(point))
    def limits(high: Double) =
      ujson.read(RenderData.json(report(high)))("points")(0)("relmseInterval")
    assert(RenderPage.html(report(0.5)).contains("54.77 % (50.00 to 70.71 %)"))
    assert(RenderPage.html(report(Double.PositiveInfinity)).contains("54.77 % (at least 50.00 %)"))
    assert(limits(0.5)("low").num == 0.25 && limits(0.5)("high").num == 0.5)
    assert(limits(Double.PositiveInfinity)("high").isNull)
    assert(RenderData.csv(report(Double.PositiveInfinity)).trim.endsWith(",0.25,"))

  test("JSON and CSV have the same figures"):
    val json = ujson.read(RenderData.json(Reports.report))
    assert(json("points").arr.map(_("samples").num.toInt).toVector == Vector(1, 4, 16, 64))
    assert(json("points")(0)("mse").num == 0.3 && json("estimated").bool == false)
    assert(json("points")(0)("relmseInterval").isNull)
    assert(json("guiding")("share").num == 0.375)
    val csv = RenderData.csv(Reports.report).linesIterator.toVector
    assert(csv.size == 5 && csv.forall(_.count(_ == ',') == 11))
    assert(csv(1).startsWith("1,0.5,0.3,0.3,"))
    val suite = ujson.read(SuiteData.json(Reports.suite))
    val fast = suite("scenes")(0)("programs")(0)
    assert(fast("points")(2)("runs").arr.size == 3)
    assert(Math.abs(fast("slope")("estimate").num + 1) < 1e-9)
    assert(suite("scenes")(0)("equalTime").num == 8)
    val bias = suite("scenes")(0)("biases")(0)
    assert(bias("program").str == "The slow" && bias("p").num < 0.05)
    assert(Math.abs(bias("wholeImage")(0)("mean").num / 1.1 /
      bias("wholeImage")(0)("otherMean").num - 1) < 1e-6)
    assert(Math.abs(fast("errorAtEqualTime").num - 0.075) < 1e-9)
    assert(SuiteData.csv(Reports.suite).linesIterator.size == 1 + 2 * 9)

  test("every line of a chart has its name in the legend"):
    def legend(page: String) =
      raw"""class="legend"[^>]*>([^<]*)<""".r.findAllMatchIn(page).map(_.group(1)).toSet
    val guide = "independent samples, slope −1"
    assert(Set("independent samples, slope −0.5", "this rendering").subsetOf(legend(pages.head._2)))
    assert(Set(guide, "target error", "The fast").subsetOf(legend(pages(1)._2)))

  test("a busy machine is warned of, on top and at each time"):
    val one = Reports.suite.scenes.head
    val disturbed = one.programs.head.copy(otherShare = Some(0.23))
    val scene = one.copy(programs = disturbed +: one.programs.tail)
    val busy = SuitePage.html(Reports.suite.copy(scenes = Vector(scene)))
    val words = "On A box, other programs took much of the processors: 23 % while The fast ran;"
    assert(busy.contains(words) && busy.contains(">3.000 s ⚠</td>") && busy.contains("23 % ⚠"))
    val loaded = Reports.suite.copy(machine = Reports.machine.copy(load = Some(1.92)))
    val began = "The machine was busy when measuring began (load 1.92 on 2"
    assert(SuitePage.html(loaded).contains(began))
    // The load may be that of what had just ended: the share of each run tells more
    val shares = one.copy(programs = one.programs.map(_.copy(otherShare = Some(0.01))))
    val known = SuitePage.html(loaded.copy(scenes = Vector(shares)))
    assert(!known.contains(began) && !known.contains(" ⚠<"))
    assert(!pages(1)._2.contains("class=\"warning\"") && !pages(1)._2.contains(" ⚠<"))
