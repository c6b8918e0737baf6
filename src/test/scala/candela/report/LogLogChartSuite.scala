package candela.report

import org.scalatest.funsuite.AnyFunSuite

import javax.xml.parsers.DocumentBuilderFactory
import org.w3c.dom.{Element, NodeList}

class LogLogChartSuite extends AnyFunSuite:
  private val marks = Vector(1.0, 10.0, 100.0).map(x => Mark(x, 1 / x, 0.5 / x, 2 / x, s"at <$x>"))
  private val chart = LogLogChart(
    "A & B",
    "seconds",
    "error",
    Vector(Series("<one>", 0, isThin = false, marks), Series("two", 9, isThin = true, marks)),
    Some(-1.0)
  )

  private def parsed(text: String): Element =
    val builder = DocumentBuilderFactory.newInstance.newDocumentBuilder
    builder.parse(java.io.ByteArrayInputStream(text.getBytes("UTF-8"))).getDocumentElement

  private def elements(list: NodeList): Vector[Element] =
    Vector.tabulate(list.getLength)(list.item).collect { case e: Element => e }

  test("a chart of its own is well-formed, and has its style with it"):
    val svg = parsed(chart.standalone)
    assert(svg.getTagName == "svg")
    assert(elements(svg.getElementsByTagName("style")).head.getTextContent.contains("color-scheme"))
    assert(elements(svg.getElementsByTagName("title")).exists(_.getTextContent == "at <1.0>"))

  test("a mark whose interval reaches 0 has no bar, and nothing is drawn at infinity"):
    def bars(low: Double): Int =
      val odd = Vector(Mark(1, 1, low, 2, "a"), Mark(10, 0.1, 0.05, 0.2, "b"))
      val text =
        LogLogChart("A", "x", "y", Vector(Series("s", 0, isThin = false, odd)), None).standalone
      assert(!text.contains("NaN") && !text.contains("Infinity"), text)
      elements(parsed(text).getElementsByTagName("line")).count(_.getAttribute("class") == "bar")
    assert(bars(0.5) == 2)
    assert(bars(0) == 1)
    assert(bars(-1) == 1)

  test("equal ratios are equal distances"):
    val line = elements(parsed(chart.svg.render).getElementsByTagName("polyline")).head
    val places = line.getAttribute("points").split(' ').map(_.split(',').map(_.toDouble))
    // Rounded to a tenth of a pixel.
    assert(Math.abs((places(1)(0) - places(0)(0)) - (places(2)(0) - places(1)(0))) < 0.25)
    assert(Math.abs((places(1)(1) - places(0)(1)) - (places(2)(1) - places(1)(1))) < 0.25)
    assert(places(0)(1) < places(2)(1), "smaller errors are further down")

  test("the guide of slope −1 lies on a curve of slope −1"):
    val lines = elements(parsed(chart.svg.render).getElementsByTagName("line"))
    val guide = lines.find(_.getAttribute("class") == "guideline").get
    def number(name: String) = guide.getAttribute(name).toDouble
    val places = elements(parsed(chart.svg.render).getElementsByTagName("polyline"))
      .head.getAttribute("points").split(' ').map(_.split(',').map(_.toDouble))
    // Rounded to a tenth of a pixel, as above
    assert(Math.abs(number("x2") - places(2)(0)) < 0.25)
    assert(Math.abs(number("y2") - places(2)(1)) < 0.25)

  test("what has no logarithm is left out, and nothing at all is drawn as nothing"):
    val zero = Vector(Mark(1, 0, 0, 0, "zero"))
    val empty = LogLogChart("t", "x", "y", Vector(Series("s", 0, isThin = false, zero)), Some(-1.0))
    assert(elements(parsed(empty.svg.render).getElementsByTagName("circle")).size == 1) // legend

  test("axes have between three and twelve ticks, of round numbers"):
    for high <- Vector(1.2, 2.0, 7.0, 30.0, 500.0, 1e5, 1e9) do
      val ticks = LogAxis.covering(Vector(1.0, high), 0, 100).ticks
      assert(ticks.size >= 2 && ticks.size <= 12, s"$high: $ticks")
    val words = Vector(0.01, 1e-5, 100, 0.15, 1.5, 2e-6).map(Numbers.tick)
    assert(words == Vector("0.01", "10⁻⁵", "100", "0.15", "1.5", "2·10⁻⁶"))
