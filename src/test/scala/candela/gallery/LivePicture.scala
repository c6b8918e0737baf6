package candela.gallery

import candela.cli.Main
import candela.testing.Eventually.eventually
import candela.testing.Chromium

import java.io.{ByteArrayOutputStream, PrintStream}
import java.nio.file.{Files, Path}

/** Takes the screenshot of docs/WATCHING.md, in a headless Chromium. */
object LivePicture:
  def main(args: Array[String]): Unit =
    val file = Path.of("docs/watching/live-page.jpg")
    val browser = Chromium.installed.getOrElse(sys.error(s"none of ${Chromium.names} is installed"))
    val err = ByteArrayOutputStream()
    val image = Files.createTempFile("live", ".exr")
    val words = Vector("scenes/showcase.pbrt", "--outfile", s"$image", "--watch", "0") ++
      Vector("--aov", "albedo,direct,indirect,lights")
    val rendering = Thread: () =>
      val _ = Main.run(words :+ "--spp" :+ "1024", PrintStream(err), PrintStream(err, true))
    rendering.start()
    val link = eventually("link"):
      raw"watch at (http://\S+)\n".r.findFirstMatchIn(err.toString).map(_.group(1))
    val _ = Files.createDirectories(file.getParent)
    Chromium.use(browser, s"$link#x=402&y=205&curve=agx&theme=light"): page =>
      page.resize(1280, 800)
      page.until("parseInt(document.getElementById('samples').textContent) >= 16")
      page.until("document.querySelector('#live').dataset.pixel.includes('noise')")
      val _ = Files.write(file, page.screenshot())
      page.value("document.getElementById('stop').click()")
      rendering.join()
    Files.delete(image)
