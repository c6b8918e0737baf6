package candela.report

import candela.bench.report.SuitePage
import candela.measure.{Flip, ImagePair, Metrics}
import candela.testing.Chromium

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*

/** What a page's script does, in a real browser: a headless Chromium, if there is one. */
@org.scalatest.tags.Slow
class BrowserSuite extends AnyFunSuite:
  import BrowserSuite.*

  private val pair = ImagePair(Reports.image, Reports.reference)

  private def viewer(dom: String, attribute: String): String =
    s"""class="viewer card"[^>]*data-$attribute="([^"]*)"""".r
      .findFirstMatchIn(dom).fold("")(_.group(1))

  test("the script works out the same errors as the program"):
    val relative = opened(RenderPage.html(Reports.report), "mode=heat&metric=relmse")
    assert(viewer(relative, "ready") == "heat relmse", viewer(relative, "failed"))
    val wanted = Metrics.compare(Reports.image, Reports.reference).relativeMse
    // Numbers have 16 bits in the page.
    assert(Math.abs(viewer(relative, "mean").toDouble / wanted - 1) < 1e-3)
    val flip = opened(RenderPage.html(Reports.report), "mode=heat&metric=flip")
    val mean = Flip.mean(pair)
    assert(Math.abs(viewer(flip, "mean").toDouble - mean) < 0.5 / 255)

  test("a pixel can be read, a chart chosen and the dark page asked for by the address"):
    val fragment = "x=3&y=2&chart=flip&axis=samples&theme=dark&ev=1"
    val dom = opened(RenderPage.html(Reports.report), fragment)
    assert(viewer(dom, "ready") == "slider relmse", viewer(dom, "failed"))
    val red = Reports.image(3, 2, 0)
    val readOut = raw"""class="readout">([^<]*)""".r.findFirstMatchIn(dom).get.group(1)
    assert(readOut.startsWith("pixel (3, 2)\n64 samples"))
    assert(readOut.contains("%.4f".formatLocal(java.util.Locale.ROOT, red)), readOut)
    assert(dom.contains("""data-theme="dark""""))
    val seen = raw"""<div class="chart" data-chart="(\w+)" data-axis="(\w+)">""".r
    assert(seen.findAllMatchIn(dom).map(m => (m.group(1), m.group(2))).toVector ==
      Vector(("flip", "samples")))

  test("the page of a suite shows its pictures"):
    val dom = opened(SuitePage.html(Reports.suite), "mode=flip")
    assert(viewer(dom, "ready") == "flip relmse", viewer(dom, "failed"))

  private lazy val browser: Path =
    val names = Chromium.names.mkString(", ")
    val found = Chromium.installed.getOrElse(cancel(s"none of $names is on the PATH"))
    // A browser that can't show even this tests nothing
    if !dom(found, "<p>shown</p>", "").exists(_.contains("shown")) then
      cancel(s"$found doesn't show a page of one word")
    found

  /** The page as it is after its script ran, without a network. */
  private def opened(page: String, fragment: String): String =
    dom(browser, page, fragment).getOrElse(fail(s"the page hangs: no end within $Limit seconds"))

  /** None: the browser didn't end. */
  private def dom(browser: Path, page: String, fragment: String): Option[String] =
    val folder = Files.createTempDirectory("candela-browser")
    try
      val file = Files.writeString(folder.resolve("page.html"), page)
      val out = folder.resolve("dom.html").toFile
      val command = Chromium.command(browser, folder.resolve("profile")) ++
        Vector("--virtual-time-budget=20000", "--dump-dom", s"${file.toUri}#$fragment")
      val process = ProcessBuilder(command.asJava).redirectOutput(out)
        .redirectError(folder.resolve("err.txt").toFile).start()
      val ended = process.waitFor(Limit, TimeUnit.SECONDS)
      if !ended then Chromium.kill(process)
      Option.when(ended)(Files.readString(out.toPath))
    finally Chromium.delete(folder)

object BrowserSuite:
  /** Pages take some seconds. */
  private val Limit = 120L
