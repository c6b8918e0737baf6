package candela.cli

import candela.image.ImageFiles
import candela.testing.Eventually.eventually
import candela.testing.{Chromium, OpenPage, TempFolder}

import java.io.IOException
import java.lang.management.ManagementFactory
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*

/** Measures what the live page costs: renders a scene without it, with it, and with viewers, in
  * turn, and compares the render times and Candela's own processor times. The viewers are pages in
  * Chromiums of the same machine, started before; what they draw is part of the render time, and
  * given as their processor time.
  *
  * Usage: `./sbt "Test/runMain candela.cli.WatchCost --rounds 7"`; more in docs/WATCHING.md.
  */
object WatchCost:
  // Names as Linux has them: 15 characters
  private[cli] val PageThreads = Vector("candela-observe", "candela-viewers", "HTTP-Dispatcher")
  private val CompilerThreads = Vector("C1 CompilerThre", "C2 CompilerThre")

  /** In seconds: of rendering, of Candela's processor time, of that of the page's threads and of
    * the JIT compilers (Linux only), of the browsers' meanwhile.
    */
  private final case class Cost(
      render: Double,
      own: Double,
      page: Double,
      compilers: Double,
      browsers: Double
  )

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(key, value) => key -> value }.toMap
    val rounds = options.get("--rounds").fold(7)(_.toInt)
    val scene = options.getOrElse("--scene", "scenes/showcase.pbrt")
    val spp = options.getOrElse("--spp", "32")
    val most = options.get("--viewers").fold(2)(_.toInt)
    val watched = Vector("watched, no viewer", "one viewer", "two viewers").zipWithIndex
    val ways =
      ("not watched" -> None) +: watched.take(most + 1).map((way, viewers) => way -> Some(viewers))
    val program = options.get("--program").fold(compiled)(Vector(_))
    val costs = (1 to rounds).toVector.map: round =>
      // Each way comes first now and then, so that a machine that gets warmer is fair to all
      val order = ways.indices.map(i => (i + round) % ways.size)
      val found = order.map(i => i -> cost(program, scene, spp, ways(i)._2)).toMap
      println(ways.indices.map(i => f"${found(i).render}%.2f s").mkString(
        s"round $round: ",
        ", ",
        ""
      ))
      found
    def median(all: Vector[Double]) = all.sorted.apply(all.size / 2)
    def more(i: Int)(time: Cost => Double) =
      median(costs.map(c => 100 * (time(c(i)) / time(c(0)) - 1)))
    println("                         render           processor      page's  compilers  browsers")
    for (way, i) <- ways.map(_._1).zipWithIndex do
      def seconds(time: Cost => Double) = median(costs.map(c => time(c(i))))
      println(
        f"$way%-20s ${seconds(_.render)}%7.2f s ${more(i)(_.render)}%+6.2f %%" +
          f" ${seconds(_.own)}%7.2f s ${more(i)(_.own)}%+6.2f %% ${seconds(_.page)}%7.2f s" +
          f" ${seconds(_.compilers)}%7.2f s ${seconds(_.browsers)}%7.2f s"
      )

  private def cost(
      program: Vector[String],
      scene: String,
      spp: String,
      viewers: Option[Int]
  ): Cost =
    val browser = Chromium.installed.getOrElse:
      sys.error(s"none of ${Chromium.names} is installed")
    opened(browser, viewers.getOrElse(0)): pages =>
      TempFolder.use: folder =>
        val image = folder.resolve("a.exr")
        val watch = viewers.fold(Vector.empty)(_ => Vector("--watch", "0"))
        val words = Vector(scene, "--spp", spp, "--outfile", s"$image", "--store-time")
        // They are the only descendants so far
        val browsers = descendants
        val before = browsers.map(processorSeconds).sum
        val process = start(folder, (program :+ "render") ++ words ++ watch)
        if pages.nonEmpty then
          val address = link(folder)
          pages.foreach(_.value(s"void (location.href = '$address')"))
        var own = 0.0
        val threads = ThreadTimes(process.pid)
        while process.isAlive do
          own = Math.max(own, processorSeconds(process.toHandle))
          threads.read()
          Thread.sleep(20)
        if process.exitValue != 0 then sys.error(Files.readString(folder.resolve("err.txt")))
        assert(ImageFiles.read(image).data.exists(_ > 0f))
        Cost(
          renderSeconds(image),
          own,
          threads.seconds(PageThreads.contains(_)),
          threads.seconds(CompilerThreads.contains(_)),
          descendants.map(processorSeconds).sum - before
        )

  /** As the image's metadata tell them. */
  private def renderSeconds(image: Path): Double =
    raw"renderSeconds\x00string\x00.{4}([0-9.]+)".r
      .findFirstMatchIn(Files.readString(image, ISO_8859_1))
      .fold(sys.error("no time in the image"))(_.group(1).toDouble)

  private[cli] def descendants: Vector[ProcessHandle] =
    ProcessHandle.current.descendants.iterator.asScala.toVector

  private[cli] def processorSeconds(process: ProcessHandle): Double =
    process.info.totalCpuDuration.map(_.toNanos * 1e-9).orElse(0.0)

  /** Empty pages of browsers that have done their starting. */
  private def opened[A](browser: Path, count: Int, pages: Vector[OpenPage] = Vector.empty)(
      use: Vector[OpenPage] => A
  ): A =
    if pages.size == count then
      if count > 0 then Thread.sleep(2000)
      use(pages)
    else Chromium.use(browser, "about:blank")(page => opened(browser, count, pages :+ page)(use))

  /** Processor times of a process's threads, ended ones included; nothing where there is no /proc.
    */
  private[cli] final class ThreadTimes(process: Long):
    private val found = scala.collection.mutable.Map.empty[Path, (String, Double)]

    def read(): Unit =
      val tasks = Path.of(s"/proc/$process/task").toFile.listFiles
      if tasks != null then tasks.foreach(task => read(task.toPath))

    private def read(task: Path): Unit =
      // A thread may end meanwhile
      try
        // utime and stime of proc(5), in hundredths of a second
        val fields = Files.readString(task.resolve("stat")).split("[)] ").last.split(' ')
        val ticks = fields(11).toDouble + fields(12).toDouble
        found(task) = (Files.readString(task.resolve("comm")).trim, ticks / 100)
      catch case _: IOException => ()

    def seconds(counts: String => Boolean): Double =
      found.values.collect { case (name, time) if counts(name) => time }.sum

  /** The classes that run here. */
  private[cli] def compiled: Vector[String] =
    val java = ProcessHandle.current.info.command.orElse("java")
    val flags = ManagementFactory.getRuntimeMXBean.getInputArguments
    (java +: flags.asScala.toVector) ++
      Vector("-cp", System.getProperty("java.class.path"), "candela.cli.Main")

  private[cli] def start(folder: Path, command: Vector[String]): Process =
    ProcessBuilder(command.asJava)
      .redirectOutput(folder.resolve("out.txt").toFile)
      .redirectError(folder.resolve("err.txt").toFile).start()

  private[cli] def link(folder: Path): String = eventually("link"):
    val err = folder.resolve("err.txt")
    Option.when(Files.exists(err))(Files.readString(err)).flatMap: text =>
      raw"watch at (http://\S+)\n".r.findFirstMatchIn(text).map(_.group(1))
