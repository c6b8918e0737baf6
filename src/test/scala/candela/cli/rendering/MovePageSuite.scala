package candela.cli.rendering

import candela.cli.MovedScene
import candela.testing.{Chromium, OpenPage, TempFolder}

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** The page on which the camera is moved, in a real browser, if there is one. */
@org.scalatest.tags.Slow
class MovePageSuite extends AnyFunSuite:

  private lazy val browser: Path = Chromium.installed
    .getOrElse(cancel(s"none of ${Chromium.names.mkString(", ")} is on the PATH"))

  private def using(args: String*)(test: (MovedScene, OpenPage) => Assertion): Assertion =
    TempFolder.use: folder =>
      val moved = MovedScene(folder, args = args)
      Chromium.use(browser, moved.link): page =>
        page.until("document.querySelector('#live').dataset.complete == 'true'")
        test(moved, page)
        assert(page.problems.isEmpty, page.problems.mkString("\n"))
      assert(moved.end() == 0)

  private def text(page: OpenPage) =
    page.value("document.querySelector('#cameratext').textContent").str

  /** Does something to the camera, and waits until the page shows its last picture. */
  private def moving(page: OpenPage)(act: => Unit): String =
    val before = text(page)
    act
    page.until(s"document.querySelector('#cameratext').textContent != ${ujson.write(before)}")
    page.until("!isAsking && !wanted.length && !polling && (d => d.complete == 'true' && " +
      "d.version == d.latest)(document.querySelector('#live').dataset)")
    text(page)

  private def click(page: OpenPage, selector: String): Unit =
    val _ = page.value(s"document.querySelector('$selector').click()")

  private def focus(page: OpenPage): Unit =
    val _ = page.value("document.querySelector('.stage').focus()")

  test("what a drag shows is, byte for byte, what is rendered from the file that the page writes"):
    using(): (moved, page) =>
      val statements = moving(page)(page.drag("canvas", (0.5, 0.5), (0.55, 0.5), (0.65, 0.6)))
      assert(statements == moved.statements)
      click(page, "#save")
      page.until("document.querySelector('#stage').textContent.includes('saved')")
      assert(Files.readString(moved.file).endsWith(statements))
      val shown = page.value("fetch('image?layer=color').then(a => a.arrayBuffer())" +
        ".then(b => [...new Float32Array(b)])").arr.map(_.num.toFloat).toVector
      assert(shown == moved.rendered())
      val mean = page.value("document.querySelector('#live').dataset.mean").str.toDouble
      assert(Math.abs(mean - shown.sum / shown.size) < 1e-5)

  test("mouse, wheel, keys and controls orbit, pan, move nearer, focus and change the view"):
    using(): (_, page) =>
      val first = text(page)
      def lookAt(text: String) =
        raw"LookAt (\S+ \S+ \S+)  (\S+ \S+ \S+)".r.findFirstMatchIn(text).get
      def eye(text: String) = lookAt(text).group(1)
      def target(text: String) = lookAt(text).group(2)
      focus(page)
      val turned = moving(page)(page.press("ArrowRight"))
      assert(eye(turned) != eye(first) && target(turned) == target(first))
      val near = moving(page)(page.press("+", "+"))
      assert(eye(near) != eye(turned) && target(near) == target(turned))
      val panned = moving(page)(page.press("d", "d"))
      assert(eye(panned) != eye(near) && target(panned) != target(near))
      val wider = moving(page)(page.press("]", "]"))
      assert(wider.contains("\"float fov\" 32"))
      assert(eye(moving(page)(page.wheel(".stage", -100))) != eye(panned))
      moving(page)(page.press("r", "r"))
      page.press("f", "f")
      assert(
        page.value("document.querySelector('.tool[data-tool=focus]').ariaPressed").str == "true"
      )
      val focused = moving(page)(page.drag("canvas", (0.5, 0.5)))
      assert(eye(focused) == eye(first) && focused.contains("\"float focaldistance\" 6."))
      val open = moving(page):
        page.value("document.querySelector('#lens').value = '0.2'; " +
          "document.querySelector('#lens').dispatchEvent(new Event('change'))")
        ()
      assert(open.contains("\"float lensradius\" 0.2"))

  test("one finger orbits, two pan and pinch"):
    using(): (_, page) =>
      page.resize(390, 844)
      val first = text(page)
      val turned = moving(page)(page.touch(
        "canvas",
        Vector((0.5, 0.5)),
        Vector((0.6, 0.5)),
        Vector((0.7, 0.5))
      ))
      assert(turned != first)
      val pinched = moving(page)(page.touch(
        "canvas",
        Vector((0.4, 0.5), (0.6, 0.5)),
        Vector((0.3, 0.5), (0.7, 0.5)),
        Vector((0.2, 0.5), (0.8, 0.5))
      ))
      def eye(text: String) = text.linesIterator.find(_.startsWith("LookAt")).get.split(" ")
        .slice(1, 4).map(_.toDouble)
      def distance(text: String) = Math.sqrt(eye(text).map(x => x * x).sum)
      assert(distance(pinched) < distance(turned) - 1)

  test("the page fits phones, and everything is reached by keyboard"):
    using(): (_, page) =>
      for width <- Vector(390, 1440); isDark <- Vector(false, true) do
        page.resize(width, 900, isDark)
        assert(!page.overflows, s"$width pixels")
      val order = page.tabbed(14)
      assert(order == Vector("theme", "stage", "orbit", "pan", "look at", "focus", "save", "end",
        "fov", "lens", "reset", "form", "copy", "cameratext"))

  test("an orthographic camera says why it has no field of view"):
    TempFolder.use: folder =>
      val camera = folder.resolve("flat.pbrt")
      val _ =
        Files.writeString(camera, "Camera \"orthographic\" \"float screenwindow\" [-3 3 -2 2]")
      val moved = MovedScene(folder, args = Seq("--camera", s"$camera"))
      Chromium.use(browser, moved.link): page =>
        page.until("document.querySelector('#live').dataset.complete == 'true'")
        assert(page.value("document.querySelector('#fov').disabled").bool)
        assert(page.value("document.querySelector('#remarks').textContent").str
          .startsWith("an orthographic camera has no field of view"))
        focus(page)
        assert(moving(page)(page.press("+", "+")).contains("\"float screenwindow\" [ -2.7 2.7"))
      assert(moved.end() == 0)
