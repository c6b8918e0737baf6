package candela.cli.rendering

import candela.diagnostics.{Code, Problem, SourcePos}
import candela.cli.{Captured, Main, Watched}
import candela.color.{ColorSpace, Rgb, ToneCurve}
import candela.film.Development
import candela.image.ImageFiles
import candela.render.TinyPlan
import candela.testing.{Chromium, OpenPage, TempFolder, WebClient}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Path
import java.util.concurrent.CountDownLatch

/** The live page in a real browser, if there is one. */
@org.scalatest.tags.Slow
class LivePageSuite extends AnyFunSuite:

  private lazy val browser: Path = Chromium.installed
    .getOrElse(cancel(s"none of ${Chromium.names.mkString(", ")} is on the PATH"))

  private def plan(spp: Int, file: Path) =
    TinyPlan(spp = spp, filename = file.toString): (where, sampler) =>
      Rgb(sampler.next1D(), 2 * sampler.next1D(), where.x / 40f)

  private def data(page: OpenPage, key: String) =
    page.value(s"document.querySelector('#live').dataset.$key || ''").str

  /** Waits until an image is drawn, after the end the last one, with the values at the cursor. */
  private def awaitImage(page: OpenPage): Unit =
    page.until("(d => d.version > 0 && JSON.parse(d.pixel).version == d.version && " +
      "(d.version == d.latest || d.stage == 'rendering'))(document.querySelector('#live').dataset)")

  private def click(page: OpenPage, id: String): Unit =
    val _ = page.value(s"document.getElementById('$id').click()")

  test("the picture changes, stop stops, and the values under the cursor are those of the EXR"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val running = Watched(plan(1_000_000_000, file), "--watch", "0", "--nthreads", "1")
      Chromium.use(browser, s"${running.link}#x=3&y=2&theme=dark"): page =>
        page.until("document.querySelector('#live').dataset.version > 0")
        val mean = data(page, "mean")
        assert(Math.abs(mean.toDouble - (0.5 + 1 + 0.4875) / 3) < 0.1)
        page.until(s"document.querySelector('#live').dataset.mean != '$mean'")
        page.until("document.querySelector('#charts svg')")
        assert(page.value("document.documentElement.dataset.theme").str == "dark")
        assert(running.isRunning && data(page, "stage") == "rendering")
        click(page, "stop")
        assert(running.ended == 130)
        page.until("document.querySelector('#live').dataset.stage == 'stopped'")
        awaitImage(page)
        val image = ImageFiles.read(file)
        val pixel = ujson.read(data(page, "pixel"))
        val rows = pixel("rows").arr.map(r => r("layer").str -> r("values").arr.map(_.num.toFloat))
        assert(rows.toMap.apply("color") == (0 to 2).map(image(3, 2, _)))
        assert(rows.map(_._1) == Seq("color", "noise", "variance"))
        val readout = page.value("document.querySelector('.readout').textContent").str
        assert(readout.startsWith("pixel (3, 2)\ncolour "), readout)

  test("keys move the cursor, zoom, and change exposure, tone curve and layer"):
    TempFolder.use: folder =>
      val running = Watched(plan(1_000_000_000, folder.resolve("a.exr")), "--watch", "0")
      try
        Chromium.use(browser, s"${running.link}#x=3&y=2"): page =>
          page.until("[...document.querySelector('#layer').options].length == 2")
          awaitImage(page)
          val painted = "document.querySelector('canvas').toDataURL()"
          def chosen(id: String) = page.value(s"document.getElementById('$id').value").str
          page.value(s"window.first = $painted")
          page.press("e", "e")
          assert(chosen("ev") == "0.5")
          page.until(s"$painted != window.first")
          page.press("c", "c")
          assert(chosen("curve") == "filmic")
          page.value("document.querySelector('.stage').focus()")
          page.press("ArrowRight")
          page.until("document.querySelector('.readout').textContent.startsWith('pixel (4, 2)')")
          page.press("l", "l")
          assert(chosen("layer") == "noise")
          page.until("document.querySelector('#live').dataset.mean < 0.5")
          page.value(s"window.before = $painted")
          page.press("+", "+")
          page.until(s"$painted != window.before")
      finally
        val _ = WebClient.post(s"${running.link}stop")
      assert(running.ended == 130)

  test("the page shows colours of other spaces as sRGB, and reads out those of the file"):
    TempFolder.use: folder =>
      val space = ColorSpace.named("rec2020").get
      val file = folder.resolve("a.exr")
      val gray = TinyPlan(filename = file.toString, development = Development(space = space)):
        (_, _) => Rgb(0.2f, 0.4f, 0.6f)
      val running = Watched(gray, "--watch", "0", "--watch-after")
      Chromium.use(browser, s"${running.link}#x=20&y=13"): page =>
        page.until("document.querySelector('#live').dataset.stage == 'done'")
        awaitImage(page)
        val read = ujson.read(data(page, "pixel"))("rows")(0)("values").arr.map(_.num.toFloat)
        assert(read == (0 to 2).map(ImageFiles.read(file)(20, 13, _)))
        val light = space.light(Rgb(0.2f, 0.4f, 0.6f))
        for curve <- Vector(ToneCurve.Linear, ToneCurve.Filmic) do
          val srgb = curve(light)
          val wanted = Vector(srgb.r, srgb.g, srgb.b).map: v =>
            if v <= 0 then 0.0 else 255 * (1.055 * Math.pow(v, 1 / 2.4) - 0.055)
          for (a, b) <- shown(page).zip(wanted) do
            assert(Math.abs(a - b) <= 1, s"${curve.word}: ${shown(page)}, $wanted")
          page.press("c", "c")
        click(page, "end")
        assert(running.ended == 0)

  /** The colour that the canvas has in its corner. */
  private def shown(page: OpenPage): Vector[Int] =
    page.value(
      "(c => [...c.getContext('2d').getImageData(5, 5, 1, 1).data])" +
        "(document.querySelector('canvas'))"
    ).arr.map(_.num.toInt).toVector.take(3)

  test("the page shows what --tonemap and --exposure write, with every tone curve"):
    TempFolder.use: folder =>
      // The last one is outside of sRGB's gamut
      val colors = Vector(Rgb(0.2f, 0.4f, 0.6f), Rgb(9f, 0.02f, 0.3f), Rgb(0.5f, -0.1f, 0.2f))
      for color <- colors do
        val file = folder.resolve("a.exr")
        val flat = TinyPlan(filename = file.toString)((_, _) => color)
        val running = Watched(flat, "--watch", "0", "--watch-after")
        Chromium.use(browser, s"${running.link}#x=20&y=13"): page =>
          page.until("document.querySelector('#live').dataset.stage == 'done'")
          awaitImage(page)
          val words = page.value("[...document.querySelector('#curve').options].map(o => o.value)")
          assert(words.arr.map(_.str) == ToneCurve.values.map(_.word).toSeq)
          for curve <- ToneCurve.values do
            page.value(s"document.querySelector('#curve').value = '${curve.word}'; " +
              "document.querySelector('#curve').dispatchEvent(new Event('change'))")
            for stops <- Vector("0", "1.5") do
              page.value(s"document.querySelector('#ev').value = '$stops'; " +
                "document.querySelector('#ev').dispatchEvent(new Event('input'))")
              val picture = folder.resolve("a.png")
              val words =
                Seq("--tonemap", curve.word, "--exposure", stops, "--outfile", s"$picture")
              assert(Main.run(Seq("view", file.toString) ++ words, Captured().terminal) == 0)
              val png = ImageFiles.read(picture).data.take(3).map(v => Math.round(v * 255)).toVector
              val found = shown(page)
              // Interpolation on the page: one code
              val off = found.lazyZip(png).map((a, b) => Math.abs(a - b)).max
              assert(off <= 1, s"$color, ${curve.word}, $stops: $found, $png")
          click(page, "end")
          assert(running.ended == 0)

  test("with --watch-after the page stays, for reloads and several viewers, until it is ended"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val running = Watched(plan(4, file), "--watch", "0", "--watch-after")
      Chromium.use(browser, running.link): page =>
        page.until("document.querySelector('#live').dataset.stage == 'done'")
        page.value("location.reload()")
        page.until("document.querySelector('#live').dataset.stage == 'done'")
        val _ = WebClient.get(s"${running.link}state?viewer=other&shown=0")
        page.until("document.getElementById('stage').textContent.includes('viewers')")
        // What acts on a rendering that is over is gone, and the page says where its image is
        def isSeen(id: String) = page.value(s"document.getElementById('$id').offsetWidth > 0").bool
        assert(Vector("stop", "save", "keep", "end").filter(isSeen) == Vector("end"))
        page.until(s"document.getElementById('files').textContent.startsWith('Written: $file')")
        assert(running.isRunning)
        click(page, "end")
        assert(running.ended == 0)
        page.until("document.querySelector('#live').dataset.lost == 'yes'")
        assert(page.value("document.getElementById('stage').textContent").str ==
          "done; the program has ended")
        assert(page.value("document.getElementById('files').textContent").str.contains(s"$file"))
        assert(page.value("document.getElementById('layer').disabled").bool)

  test("before the first pass the page says so; it fits phones, and breaks no policy"):
    TempFolder.use: folder =>
      val gate = CountDownLatch(1)
      val file = folder.resolve("a.exr")
      val waiting = TinyPlan(spp = 64, filename = file.toString): (where, sampler) =>
        gate.await()
        Rgb(sampler.next1D(), 2 * sampler.next1D(), where.x / 40f)
      val running = Watched(waiting, "--watch", "0", "--watch-after")
      Chromium.use(browser, running.link): page =>
        page.until("document.getElementById('stage').textContent == 'waiting for the first pass'")
        assert(page.value("document.getElementById('waiting').offsetWidth > 0").bool)
        assert(page.value("document.getElementById('layer').disabled").bool)
        assert(page.value("document.getElementById('layer').selectedOptions[0].text").str ==
          "no image yet")
        for width <- Vector(390, 1440); isDark <- Vector(false, true) do
          page.resize(width, 900, isDark)
          assert(!page.overflows, s"$width pixels")
        gate.countDown()
        page.until("document.querySelector('#live').dataset.stage == 'done'")
        page.until("document.getElementById('files').textContent.startsWith('Written')")
        // The image is asked for after the stage is known
        page.until("document.getElementById('waiting').hidden")
        page.until(
          "document.querySelector('#layer').selectedOptions[0].text == 'colour: the image'"
        )
        page.value("document.querySelector('.stage').focus()")
        page.press("ArrowRight")
        page.until("document.querySelector('.readout').textContent.startsWith('pixel (20')")
        page.resize(390, 900)
        assert(!page.overflows)
        assert(page.problems.isEmpty, page.problems.mkString("\n"))
        click(page, "end")
        assert(running.ended == 0)

  test("the image comes first and fits the window; title and warnings are the scene's"):
    TempFolder.use: folder =>
      val (file, name) = (folder.resolve("a.exr"), "scenes/kitchen <1>.pbrt")
      for (width, height) <- Vector(20 -> 15, 12 -> 30, 40 -> 10) do
        val flat =
          TinyPlan(width = width, height = height, filename = s"$file")((_, _) => Rgb.White)
        val warnings = Vector(Problem.warning(Code.Viewer, SourcePos(name, 3, 5), "nothing emits"))
        val running = Watched(flat, name, warnings, "--watch", "0", "--watch-after")
        Chromium.use(browser, s"${running.link}#x=0&y=0"): page =>
          awaitImage(page)
          assert(page.value("document.title").str == "kitchen <1>.pbrt")
          val warning = page.value("document.querySelector('details.warning').textContent").str
          assert(warning.contains("1 warning") && warning.contains(s"$name:3:5: warning: nothing"))
          for window <- Vector((1280, 800), (390, 844), (844, 390)) do
            page.resize(window._1, window._2)
            val box = page.value("(b => [b.left, b.top, b.right, b.bottom])" +
              "(document.querySelector('canvas').getBoundingClientRect())").arr.map(_.num)
            assert(
              box(0) >= 0 && box(1) <= 130 && box(2) <= window._1 && box(3) <= window._2,
              window
            )
            val aspect = (box(2) - box(0)) / (box(3) - box(1))
            assert(Math.abs(aspect / (width.toDouble / height) - 1) < 0.02, window)
            assert(!page.overflows, window)
          click(page, "end")
          assert(running.ended == 0)

  test("by keyboard alone, everything of the page is reached, in the order in which it is seen"):
    TempFolder.use: folder =>
      val running = Watched(plan(1_000_000_000, folder.resolve("a.exr")), "--watch", "0")
      try
        Chromium.use(browser, running.link): page =>
          page.until("[...document.querySelector('#layer').options].length == 2")
          page.until("document.querySelector('#charts svg')")
          val order = page.tabbed(12)
          assert(order == Vector("theme", "stage", "stop", "keep", "save", "layer", "curve") ++
            Vector("ev", "+", "−", "whole image", "showtiles"))
          page.value("document.querySelector('.stage').focus()")
          val outline = "getComputedStyle(document.activeElement).outlineStyle"
          assert(page.value(outline).str == "solid")
          // Where the wheel zooms now, it scrolled the page before
          page.value("document.activeElement.blur()")
          page.wheel(".stage", -100)
          page.until("!document.querySelector('.hint').hidden")
      finally
        val _ = WebClient.post(s"${running.link}stop")
      assert(running.ended == 130)
