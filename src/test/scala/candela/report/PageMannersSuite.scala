package candela.report

import candela.bench.report.SuitePage
import candela.testing.{Chromium, OpenPage}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** Reports on screens of all widths, by keyboard and wheel, in a real browser, if there is one. */
@org.scalatest.tags.Slow
class PageMannersSuite extends AnyFunSuite:

  private lazy val browser: Path = Chromium.installed
    .getOrElse(cancel(s"none of ${Chromium.names.mkString(", ")} is on the PATH"))

  private def opened[A](html: String)(test: OpenPage => A): A =
    val folder = Files.createTempDirectory("candela-page")
    try
      val file = Files.writeString(folder.resolve("page.html"), html)
      Chromium.use(browser, file.toUri.toString): page =>
        page.until("document.querySelector('.viewer').dataset.ready")
        test(page)
    finally Chromium.delete(folder)

  private lazy val rendering = RenderPage.html(Reports.report)

  private lazy val suite =
    val program = Reports.suite.scenes.head.programs.head
    val long = program.copy(command = "x" * 300, title = "A program of a long name, 1 thread")
    val scene = Reports.suite.scenes.head
    val all = Vector.tabulate(6)(i => long.copy(name = s"p$i", otherShare = Some(0.2)))
    SuitePage.html(Reports.suite.copy(
      machine = Reports.machine.copy(load = Some(2)),
      scenes = Vector(scene, scene.copy(name = "c", title = "Another", programs = all))
    ))

  for (name, page) <- Vector("rendering" -> (() => rendering), "suite" -> (() => suite)) do
    test(s"the page of a $name fits into 390 and 1,440 pixels, light and dark, without errors"):
      opened(page()): page =>
        for width <- Vector(390, 1440); isDark <- Vector(false, true) do
          page.resize(width, 900, isDark)
          assert(!page.overflows, s"$width pixels")
          val paper = page.value("getComputedStyle(document.body).backgroundColor").str
          assert((paper == "rgb(20, 24, 29)") == isDark)
        assert(page.problems.isEmpty, page.problems.mkString("\n"))

  test("words of charts have at least 9 pixels on a phone"):
    opened(rendering): page =>
      page.resize(390, 900)
      val heights = page.value(
        "[...document.querySelectorAll('svg')].filter(s => s.clientWidth).map(s => " +
          "12 * s.clientWidth / s.viewBox.baseVal.width)"
      ).arr.map(_.num)
      // One of errors, one of time
      assert(heights.size == 2 && heights.forall(_ >= 9), heights)

  test("the picture of a report takes keys when it has the focus, and Tab comes to it"):
    opened(rendering): page =>
      assert(page.tabbed(30).contains("stage"))
      page.value("document.querySelector('.stage').focus()")
      def readout = page.value("document.querySelector('.readout').textContent").str
      def painted = page.value("document.querySelector('canvas').toDataURL()").str
      page.press("ArrowRight")
      assert(readout.startsWith("pixel (12, 8)"))
      page.press("ArrowDown")
      page.press("ArrowRight")
      assert(readout.startsWith("pixel (13, 9)"))
      for (key, mode) <- Vector("." -> "slider", "+" -> "slider", "e" -> "slider", "f" -> "flip") do
        val before = painted
        page.press(key, key)
        assert(painted != before, key)
        assert(page.value("document.querySelector('.viewer').dataset.ready").str == s"$mode relmse")

  test("the wheel scrolls the page, and zooms with Ctrl or when the picture has the focus"):
    opened(rendering): page =>
      def zoomed = page.value("document.querySelector('.stage').dataset.zoomed || 'false'").str
      def top = page.value("window.scrollY").num
      page.value("document.querySelector('.stage').scrollIntoView({block: 'center'})")
      val before = top
      page.wheel(".stage", -200)
      page.until(s"window.scrollY < $before && !document.querySelector('.hint').hidden")
      assert(zoomed == "false")
      page.value("document.querySelector('.stage').scrollIntoView({block: 'center'})")
      page.wheel(".stage", -200, modifiers = 2)
      page.until("document.querySelector('.stage').dataset.zoomed == 'true'")
      page.value("[...document.querySelectorAll('[data-zoom=whole]')][0].click()")
      assert(zoomed == "false")
      page.value("document.querySelector('.stage').focus()")
      val still = top
      page.wheel(".stage", -200)
      page.until("document.querySelector('.stage').dataset.zoomed == 'true'")
      assert(top == still)

  test("on a screen, all columns of the results are seen; pairs of numbers wrap"):
    opened(suite): page =>
      page.resize(1440, 900)
      val hidden = page.value("[...document.querySelectorAll('.scroll')].filter(b => " +
        "b.scrollWidth > b.clientWidth && b.querySelector('th:last-child').textContent == " +
        "'other programs').length").num
      assert(hidden == 0)

  test("a wide table scrolls in its box, which the keyboard reaches"):
    opened(suite): page =>
      page.resize(390, 900)
      val boxes = page.value("[...document.querySelectorAll('.scroll')].map(b => " +
        "[b.scrollWidth, b.clientWidth, b.tabIndex, b.getBoundingClientRect().right])").arr
      assert(boxes.exists(b => b(0).num > b(1).num))
      assert(boxes.forall(b => b(2).num == 0 && b(3).num <= 390))
