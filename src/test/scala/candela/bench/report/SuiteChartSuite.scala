package candela.bench.report

import candela.report.Reports
import org.scalatest.funsuite.AnyFunSuite

import javax.xml.parsers.DocumentBuilderFactory

class SuiteChartSuite extends AnyFunSuite:
  private val one = Reports.suite.scenes.head
  private val many = Reports.suite.copy(scenes =
    Vector.tabulate(5)(i => one.copy(name = s"box$i", title = s"Box $i", target = 0.2 / (i + 1)))
  )

  private def texts(svg: String): Vector[String] =
    val builder = DocumentBuilderFactory.newInstance.newDocumentBuilder
    val root = builder.parse(java.io.ByteArrayInputStream(svg.getBytes("UTF-8")))
    val all = root.getElementsByTagName("text")
    Vector.tabulate(all.getLength)(all.item(_).getTextContent)

  test("all scenes are in one picture, with one legend and who was first"):
    val words = texts(SuiteChart.svg(many))
    for i <- 0 until 5 do assert(words.count(_ == s"Box $i") == 1)
    assert(words.count(_ == "The fast") == 1 && words.count(_ == "The slow") == 1)
    // 1.2 / samples = 0.2 at 6 samples, half a second each; "slow" is drawn beside another one
    assert(words.contains("0.2 first: The fast, 3.0 s"))
    // 1.2 / 16 = 0.075 is the least
    assert(words.contains("0.05 was not reached"))

  test("the next best is named, too"):
    val drawn = many.copy(scenes =
      many.scenes.map(s =>
        s.copy(programs = s.programs.map(_.copy(isThin = false)))
      )
    )
    assert(texts(SuiteChart.svg(drawn)).contains("0.2 first: The fast, 3.0 s (next 12 s)"))

  test("a suite of one scene is drawn large"):
    val words = texts(SuiteChart.svg(Reports.suite))
    assert(words.contains("A box: relative MSE") && words.contains("total time (s)"))

  test("the goal is a line across, if it is among the curves"):
    def goals(s: SceneResult) =
      "class=\"goal\"".r.findAllIn(SuiteChart.svg(Reports.suite.copy(scenes = Vector(s)))).size
    assert(goals(one) == 1 && goals(one.copy(target = 1e-6)) == 0)
