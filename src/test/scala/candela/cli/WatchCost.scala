package candela.cli

import candela.image.ImageFiles
import candela.testing.Chromium

import java.lang.management.ManagementFactory
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*

/** Measures what the live page costs: renders a scene without it, with it, and with viewers, in
  * turn, and compares the render times. The viewers are pages in a Chromium of the same machine;
  * what they draw is part of the cost.
  *
  * Usage: `./sbt "Test/runMain candela.cli.WatchCost --rounds 7"`; more in docs/WATCHING.md.
  */
object WatchCost:
  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(key, value) => key -> value }.toMap
    val rounds = options.get("--rounds").fold(7)(_.toInt)
    val scene = options.getOrElse("--scene", "scenes/showcase.pbrt")
    val spp = options.getOrElse("--spp", "32")
    val ways = Vector("not watched" -> None, "watched, no viewer" -> Some(0)) ++
      Vector("one viewer" -> Some(1), "two viewers" -> Some(2))
    val seconds = (1 to rounds).toVector.map: round =>
      // Each way comes first now and then, so that a machine that gets warmer is fair to all
      val order = ways.indices.map(i => (i + round) % ways.size)
      val found = order.map(i => i -> render(scene, spp, ways(i)._2)).toMap
      println(ways.indices.map(i => f"${found(i)}%.2f s").mkString(s"round $round: ", ", ", ""))
      found
    def median(all: Vector[Double]) = all.sorted.apply(all.size / 2)
    for (way, i) <- ways.map(_._1).zipWithIndex do
      val more = median(seconds.map(s => 100 * (s(i) / s(0) - 1)))
      println(f"$way%-20s ${median(seconds.map(_(i)))}%8.2f s  $more%+6.2f %%")

  /** Seconds of rendering, as the image's metadata tells them. */
  private def render(scene: String, spp: String, viewers: Option[Int]): Double =
    TempFolder.use: folder =>
      val image = folder.resolve("a.exr")
      val watch = viewers.fold(Vector.empty)(_ => Vector("--watch", "0"))
      val words = Vector(scene, "--spp", spp, "--outfile", s"$image", "--store-time")
      val process = start(folder, words ++ watch)
      for count <- viewers if count > 0 do
        val browser =
          Chromium.installed.getOrElse(sys.error(s"none of ${Chromium.names} is installed"))
        looking(browser, link(folder), count)(process.waitFor(): Unit)
      if !process.waitFor(1, TimeUnit.HOURS) || process.exitValue != 0 then
        sys.error(Files.readString(folder.resolve("err.txt")))
      assert(ImageFiles.read(image).data.exists(_ > 0f))
      raw"renderSeconds\x00string\x00.{4}([0-9.]+)".r
        .findFirstMatchIn(Files.readString(image, ISO_8859_1))
        .fold(sys.error("no time in the image"))(_.group(1).toDouble)

  private def looking(browser: Path, link: String, count: Int)(body: => Unit): Unit =
    if count == 0 then body
    else Chromium.use(browser, link)(_ => looking(browser, link, count - 1)(body))

  private def start(folder: Path, words: Vector[String]): Process =
    val program = ProcessHandle.current.info.command.orElse("java")
    val flags = ManagementFactory.getRuntimeMXBean.getInputArguments
    val command = (program +: flags.asScala.toVector) ++
      Vector("-cp", System.getProperty("java.class.path"), "candela.cli.Main") ++ words
    ProcessBuilder(command.asJava)
      .redirectOutput(folder.resolve("out.txt").toFile)
      .redirectError(folder.resolve("err.txt").toFile).start()

  private def link(folder: Path): String = Chromium.eventually("link"):
    val err = folder.resolve("err.txt")
    Option.when(Files.exists(err))(Files.readString(err)).flatMap: text =>
      raw"watch at (http://\S+)\n".r.findFirstMatchIn(text).map(_.group(1))
