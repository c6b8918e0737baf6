package candela.jmh

import candela.accel.{Accelerator, BruteForce, Primitives}
import candela.accel.tracing.{Grid, Hierarchies}
import candela.geometry.{Hit, Ray}
import candela.math.Vec3
import candela.report.{LogLogChart, Mark, Series}

import java.lang.management.ManagementFactory
import java.nio.file.{Files, Path}
import java.util.SplittableRandom

/** What building takes, how much memory is held, and how long a ray takes, for more and more
  * triangles, with a hierarchy, a uniform grid, and no structure at all.
  *
  * Options: `--most N` triangles (10 million) and `--out FOLDER` (docs/scale), where `scale.csv`
  * and `scale.svg` are written; `--ply FILE` writes a mesh of that many triangles and a scene of it
  * instead. All is measured in one thread, in its processor time.
  */
object Scale:
  def main(words: Array[String]): Unit =
    val options = words.grouped(2).collect { case Array(k, v) => k -> v }.toMap
    val most = options.get("--most").fold(10_000_000)(_.toInt)
    options.get("--ply") match
      case Some(file) => write(Path.of(file), most)
      case None => measure(Path.of(options.getOrElse("--out", "docs/scale")), most)

  private def write(file: Path, triangles: Int): Unit =
    Torus(triangles).write(file)
    val name = file.getFileName.toString
    val scene = file.resolveSibling(name.stripSuffix(".ply") + ".pbrt")
    Files.writeString(scene, Torus.scene(name)): Unit

  private val kinds: Vector[(String, Primitives => Accelerator)] = Vector(
    "hierarchy" -> (Hierarchies.of(_)),
    "grid" -> (Grid(_)),
    "none" -> (BruteForce(_))
  )

  /** @param bytes a triangle, mesh and accelerator together
    * @param ray   seconds for one
    */
  private final case class Row(
      kind: String,
      triangles: Int,
      build: Double,
      bytes: Double,
      ray: Double
  )

  private def measure(folder: Path, most: Int): Unit =
    val sizes = Iterator.iterate(1000.0)(_ * Math.sqrt(10)).map(_.round.toInt).takeWhile(_ <= most)
    val warm = Torus(100_000)
    for (_, make) <- kinds.init; _ <- 0 until 8 do
      timeOfRay(make(warm.primitives), 100_000): Unit
    val rows =
      for
        size <- sizes.toVector
        (kind, make) <- kinds
        if kind != "none" || size <= MaxTrianglesOfNone
      yield
        val row = measure(kind, make, size)
        println(csv(row))
        row
    Files.createDirectories(folder): Unit
    val table = (Header +: rows.map(csv)).mkString("", "\n", "\n")
    Files.writeString(folder.resolve("scale.csv"), table): Unit
    Files.writeString(folder.resolve("scale.svg"), chart(rows).standalone): Unit

  private def measure(kind: String, make: Primitives => Accelerator, size: Int): Row =
    val empty = liveBytes()
    val primitives = Torus(size).primitives
    val repeats = Math.max(1, Math.min(5, 3_000_000 / size))
    val seconds = (0 until repeats).map: _ =>
      val start = cpu()
      make(primitives): Unit
      (cpu() - start) * 1e-9
    val made = make(primitives)
    val bytes = (liveBytes() - empty).toDouble / primitives.count
    val rays = if kind == "none" then Math.max(20, 10_000_000 / size) else 200_000
    timeOfRay(made, rays): Unit
    Row(kind, primitives.count, seconds.min, bytes, timeOfRay(made, rays))

  /** Rays between points on a sphere around the torus: half of them closest hits, half shadows. */
  private def timeOfRay(accelerator: Accelerator, count: Int): Double =
    val random = SplittableRandom(7)
    def point() =
      val z = 2 * random.nextDouble() - 1
      val phi = 2 * Math.PI * random.nextDouble()
      val r = Math.sqrt(1 - z * z)
      Vec3((2 * r * Math.cos(phi)).toFloat, (2 * r * Math.sin(phi)).toFloat, (2 * z).toFloat)
    val ends = Array.fill(2 * count)(point())
    val (ray, hit) = (Ray(), Hit())
    val start = cpu()
    var i = 0
    while i < count do
      ray.set(ends(2 * i), ends(2 * i + 1) - ends(2 * i), Float.PositiveInfinity)
      if i % 2 == 0 then accelerator.closest(ray, hit): Unit
      else accelerator.isOccluded(ray, hit): Unit
      i += 1
    (cpu() - start) * 1e-9 / count

  private def cpu(): Long = ManagementFactory.getThreadMXBean.getCurrentThreadCpuTime

  private def liveBytes(): Long =
    for _ <- 0 until 3 do System.gc()
    ManagementFactory.getMemoryMXBean.getHeapMemoryUsage.getUsed

  private val Header = "accelerator,triangles,build seconds,bytes a triangle,microseconds a ray"

  private def csv(r: Row): String =
    f"${r.kind},${r.triangles},${r.build}%.6f,${r.bytes}%.1f,${r.ray * 1e6}%.4f"

  private def chart(rows: Vector[Row]): LogLogChart =
    def series(name: String, kind: String, color: Int, isThin: Boolean)(y: Row => Double) =
      val marks = rows.filter(_.kind == kind).map: r =>
        Mark(r.triangles, y(r), y(r), y(r), f"${r.triangles}%,d: ${y(r)}%.4g s")
      Series(name, color, isThin, marks)
    LogLogChart(
      "Rays and building, by the number of triangles",
      "triangles",
      "seconds",
      Vector(
        series("hierarchy, 10⁶ rays", "hierarchy", 0, false)(_.ray * 1e6),
        series("grid, 10⁶ rays", "grid", 1, false)(_.ray * 1e6),
        series("no structure, 10⁶ rays", "none", 2, false)(_.ray * 1e6),
        series("hierarchy, built", "hierarchy", 0, true)(_.build),
        series("grid, built", "grid", 1, true)(_.build)
      ),
      guideSlope = None
    )

  /** Triangles from which on a ray takes some milliseconds. */
  private val MaxTrianglesOfNone = 400_000
