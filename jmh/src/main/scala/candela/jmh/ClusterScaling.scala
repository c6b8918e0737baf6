package candela.jmh

import candela.base.Version
import candela.cli.options.CommandLine
import candela.job.SceneLoader
import candela.render.*
import candela.render.storage.{FilmFile, FilmHeader, FilmWriter}
import candela.report.{LogLogChart, Mark, Series}
import candela.scenefile.SceneFiles

import java.lang.management.ManagementFactory
import java.nio.file.{Files, Path}

/** Measures what the parts of a rendering on a cluster cost, and simulates up to 1,024 cores.
  *
  * Options: `--scene FILE` `--spp N` `--shards N` (measured) `--pixels N` (of the simulated film)
  * `--svg FILE`, beside which its numbers are written as CSV. Figures are processor time, so that
  * other processes disturb little.
  */
object ClusterScaling:
  def main(args: Array[String]): Unit =
    val given_ = args.grouped(2).collect { case Array(k, v) => k.drop(2) -> v }.toMap
    val options = Map(
      "scene" -> "scenes/showcase.pbrt",
      "spp" -> "64",
      "shards" -> "32",
      "pixels" -> "2073600",
      "svg" -> "docs/scale/cluster.svg"
    ) ++ given_
    val (costs, work) = measured(options)
    val pixels = options("pixels").toDouble
    print(costs, work, pixels)
    val model = ClusterModel(costs, ClusterAssumptions())
    val series = for (hours, i) <- Hours.zipWithIndex yield curve(model, hours, i)
    val ideal = for (hours, i) <- Hours.zipWithIndex yield straight(hours, i)
    val chart = LogLogChart(
      s"Rendering on Spark, simulated: ${options("scene")}, ${(pixels * 1e-6).round} megapixels",
      "cores",
      "seconds",
      series ++ ideal,
      guideSlope = None
    )
    Files.writeString(Path.of(options("svg")), chart.standalone + "\n"): Unit
    val rows = for (hours, s) <- Hours.zip(series); m <- s.marks yield s"$hours,${m.x},${m.y}\n"
    val table = rows.mkString("core hours,cores,seconds\n", "", "")
    Files.writeString(Path.of(options("svg").stripSuffix(".svg") + ".csv"), table): Unit

  private val Hours = Vector(1, 10, 100)
  private val Cores = Vector.iterate(1, 11)(_ * 2)

  /** The first is `--spark`'s default. */
  private val PerCore = Vector(4, 1, 16)

  private def curve(model: ClusterModel, hours: Int, color: Int): Series =
    println(
      s"\n$hours core hours\n\n| cores | ${PerCore.map(n => s"$n per core").mkString(" | ")} |"
    )
    println("|---" * (1 + PerCore.size) + "|")
    val marks = Cores.map: cores =>
      val work = hours * 3600.0
      val times = PerCore.map(model.seconds(work, cores, _))
      val cells = times.map(t => f"$t%.0f s, ${100 * work / cores / t}%.0f %%")
      println(s"| $cores | ${cells.mkString(" | ")} |")
      Mark(cores, times.head, times.head, times.head, s"$cores cores: ${cells.head}")
    Series(s"$hours core hours", color, isThin = false, marks)

  private def straight(hours: Int, color: Int): Series =
    def mark(cores: Int) =
      val time = hours * 3600.0 / cores
      Mark(cores, time, time, time, f"ideal: $time%.0f s")
    Series(s"$hours core hours, ideal", color, isThin = true, Vector(mark(1), mark(Cores.last)))

  /** Costs of a film of the asked size, and the processor time of all shards. */
  private def measured(o: Map[String, String]): (ClusterCosts, Double) =
    val words = Vector("render", o("scene"), "--spp", o("spp"), "-j", "1")
    val options =
      CommandLine.parse(words).fold(e => throw IllegalArgumentException(e.err), identity)
    val begin = cpu()
    val loaded = SceneLoader.FromFile.load(o("scene"), options.sceneSettings, options.building)
    val building = cpu() - begin
    val plan = loaded.plan
    val count = o("shards").toInt
    val folder = Files.createTempDirectory("candela-scaling")
    val shards = Vector.tabulate(count)(i => Shard(i, count))
    render(plan, shards.head, folder.resolve("warm.film")): Unit
    val times = shards.map(s => render(plan, s, folder.resolve(s"${s.index}.film")))
    val films = shards.take(FanIn).map(s => FilmFile.open(folder.resolve(s"${s.index}.film")))
    val sum = folder.resolve("sum.film")
    def add(): (Double, Double) =
      var written = 0.0
      val start = cpu()
      Renderer.gather(
        plan,
        state =>
          films.foreach(f => FilmFile.open(f.path).load(state))
          val before = cpu()
          write(state, sum)
          written = cpu() - before
      ): Unit
      ((cpu() - start - written) / films.size, written)
    for _ <- 0 until 5 do add(): Unit // warms up
    val (addition, writing) = add()
    val scale = o("pixels").toDouble / plan.crop.pixels
    val mean = times.sum / count
    val bundle = SceneFiles.of(loaded.description).map(Files.size(_)).sum.toDouble
    val bytes = Files.size(sum).toDouble
    println(f"film of ${plan.crop.pixels} pixels: ${bytes / plan.crop.pixels}%.1f bytes per pixel")
    (
      ClusterCosts(
        times.map(_ / mean),
        bytes * scale,
        addition * scale,
        writing * scale,
        bundle,
        building
      ),
      times.sum
    )

  private def render(plan: RenderPlan, shard: Shard, to: Path): Double =
    val checkpointer = new Checkpointer:
      def restore(state: RenderState): Unit = ()
      def isDue: Boolean = false
      def save(state: RenderState): Unit = write(state, to)
      def discard(): Unit = ()
      def finish(): Unit = ()
    val begin = cpu()
    Renderer.render(plan, RenderControl(1, shard = shard, checkpointer = Some(checkpointer))): Unit
    cpu() - begin

  private def write(state: RenderState, to: Path): Unit =
    val none = Vector.empty
    val header =
      FilmHeader(Version.current, "", "", none, none, Vector.empty, "", 1, 1, 0, Set(0), 1)
    val writer = FilmWriter(to)
    writer.write(header, state)
    writer.commit()

  private def print(c: ClusterCosts, work: Double, pixels: Double): Unit =
    val spread = Math.sqrt(c.shards.map(t => (t - 1) * (t - 1)).sum / c.shards.size)
    println(f"shards: ${work / c.shards.size}%.2f s each, spread ${100 * spread}%.1f %%")
    println(f"at ${pixels * 1e-6}%.2f megapixels: film ${c.filmBytes * 1e-6}%.0f MB")
    println(f"adding a film ${c.addition}%.2f s, writing one ${c.writing}%.2f s")
    println(f"scene: ${c.bundle * 1e-6}%.2f MB, read and built in ${c.building}%.2f s")

  /** Films that are added at once. */
  private val FanIn = 8

  /** Processor time of this process, in seconds. */
  private def cpu(): Double =
    ManagementFactory.getOperatingSystemMXBean match
      case os: com.sun.management.OperatingSystemMXBean => os.getProcessCpuTime * 1e-9
      case _ => System.nanoTime * 1e-9
