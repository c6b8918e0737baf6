package candela.cli

import candela.testing.{Chromium, TempFolder}

import java.net.URI
import java.nio.file.Files

import scala.util.Using

/** Measures what a viewer of the live page takes from a rendering that is under way: the page comes
  * and goes, and each time with it is compared with the times without it before and after. One
  * process, compiled and warm, so that neither start-up nor a slow change of the machine's speed
  * counts, as they do between whole renders (`WatchCost`).
  *
  * Usage: `./sbt "Test/runMain candela.cli.WatchRates --rounds 10"`; more in docs/WATCHING.md.
  */
object WatchRates:
  /** What was done until now, by samples; `workers` are the seconds of the render threads. */
  private final case class Count(
      nanos: Long,
      samples: Double,
      workers: Double,
      page: Double,
      browsers: Double
  )

  /** Of one phase: samples a second, samples a second of the render threads, and processors busy
    * with the page and in the browser.
    */
  private final case class Rates(all: Double, workers: Double, page: Double, browsers: Double)

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(key, value) => key -> value }.toMap
    def seconds(key: String, default: Double) = options.get(key).fold(default)(_.toDouble)
    val rounds = options.get("--rounds").fold(10)(_.toInt)
    val program = options.get("--program").fold(WatchCost.compiled)(Vector(_))
    val browser = Chromium.installed.getOrElse:
      sys.error(s"none of ${Chromium.names} is installed")
    val phases = Chromium.use(browser, "about:blank"): page =>
      TempFolder.use: folder =>
        val scene = Files.writeString(folder.resolve("a.pbrt"), Furnace)
        val words = Vector("render", s"$scene", "--outfile", s"${folder.resolve("a.exr")}")
        val process = WatchCost.start(folder, program ++ words ++ Vector("--watch", "0"))
        try
          val link = WatchCost.link(folder)
          pause(seconds("--warm-up", 40))
          (0 to 2 * rounds).toVector.map: i =>
            val address = if i % 2 == 1 then link else "about:blank"
            page.value(s"void (location.href = '$address')")
            pause(seconds("--settle", 3))
            phase(process, link, seconds("--seconds", 8))
        finally
          process.destroy()
          process.waitFor(): Unit
    val without = phases.grouped(2).map(_.head).toVector
    val watched = phases.grouped(2).collect { case Vector(_, phase) => phase }.toVector
    def change(rate: Rates => Double) =
      val all = watched.indices.map: i =>
        100 * (2 * rate(watched(i)) / (rate(without(i)) + rate(without(i + 1))) - 1)
      val mean = all.sum / all.size
      val error = Math.sqrt(all.map(c => (c - mean) * (c - mean)).sum / (all.size - 1) / all.size)
      f"$mean%+.2f ± $error%.2f %%"
    println(s"samples per second, with a viewer: ${change(_.all)}")
    println(s"samples per second of a render thread: ${change(_.workers)}")
    def busy(name: String)(rate: Rates => Double) =
      def mean(phases: Vector[Rates]) = phases.map(rate).sum / phases.size
      println(f"processors busy with $name: ${mean(watched)}%.4f, without ${mean(without)}%.4f")
    busy("the page's threads")(_.page)
    busy("the browser")(_.browsers)

  /** Every pixel costs the same, so that it doesn't matter which part is being rendered. */
  private val Furnace =
    """Camera "perspective" "float fov" 60
      |Film "rgb" "integer xresolution" 1000 "integer yresolution" 750
      |Sampler "zsobol" "integer pixelsamples" 1000000
      |WorldBegin
      |LightSource "point" "point3 from" [ 0.1 0.2 0.3 ]
      |Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
      |Shape "sphere" "float radius" 1
      |""".stripMargin

  private def pause(seconds: Double): Unit = Thread.sleep((1000 * seconds).toLong)

  private def phase(process: Process, link: String, seconds: Double): Rates =
    val begin = count(process, link)
    pause(seconds)
    val end = count(process, link)
    val time = (end.nanos - begin.nanos) * 1e-9
    val samples = end.samples - begin.samples
    val rates = Rates(
      samples / time,
      samples / (end.workers - begin.workers),
      (end.page - begin.page) / time,
      (end.browsers - begin.browsers) / time
    )
    println(
      f"${rates.all}%.0f samples/s, ${rates.workers}%.0f of a thread, " +
        f"page ${rates.page}%.4f, browser ${rates.browsers}%.4f"
    )
    rates

  /** The state is asked for without a name, so that this doesn't count as a viewer. */
  private def count(process: Process, link: String): Count =
    val browsers = WatchCost.descendants.filter(_.pid != process.pid)
    val state = Using.resource(URI(s"${link}state").toURL.openStream())(ujson.read(_))
    val now = System.nanoTime
    val threads = WatchCost.ThreadTimes(process.pid)
    threads.read()
    Count(
      now,
      state("rate").num * state("seconds").num,
      threads.seconds(_.startsWith("candela-worker")),
      threads.seconds(WatchCost.PageThreads.contains(_)),
      browsers.map(WatchCost.processorSeconds).sum
    )
