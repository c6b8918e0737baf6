package candela.bench.robustness

import candela.io.WholeFile
import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*

import candela.bench.report.{Robust, RobustProgram}
import candela.bench.suite.{Commands, Outcome}
import candela.geometry.Ray
import candela.shapes.TriangleSoup

/** Embree in both of its modes, by PyPI's `embreex`, with the rays that Candela is given.
  *
  * @param python a Python that has embreex
  */
final class EmbreeRays(python: String, folder: Path, commands: Commands):
  import EmbreeRays.*

  private val script = folder.resolve("embree.py")
  WholeFile.write(script, Resource)

  /** Counts misses of `count` rays.
    *
    * @param next sets a ray; returns the distance of its hit, or NaN if only a hit is asked for
    */
  def tally(name: String, soup: TriangleSoup, count: Long)(
      next: Ray => Double
  ): Map[String, Robust] =
    val parts = Iterator.iterate(count)(_ - MaxRays).takeWhile(_ > 0)
      .map(left => part(name, soup, Math.min(left, MaxRays).toInt)(next)).toVector
    val failure = parts.collectFirst { case Left(why) => Robust.Failed(why) }
    val faults = parts.collect { case Right(counts) => counts }
    programs.indices.map(k =>
      programs(k).key -> failure.getOrElse(Robust.Counted(faults.map(_(k)).sum, count))
    ).toMap

  private def part(name: String, soup: TriangleSoup, count: Int)(
      next: Ray => Double
  ): Either[String, Vector[Long]] =
    val input = Files.createDirectories(folder.resolve("embree"))
    val ray = Ray()
    val rays = buffer(24 * count)
    val far = buffer(8 * count)
    var i = 0
    while i < count do
      val distance = next(ray)
      for x <- Array(ray.ox, ray.oy, ray.oz, ray.dx, ray.dy, ray.dz) do rays.putFloat(x): Unit
      far.putDouble(distance): Unit
      i += 1
    val hasFar = !far.getDouble(0).isNaN
    WholeFile.write(input.resolve(s"$name.mesh"), mesh(soup))
    WholeFile.write(input.resolve(s"$name.rays"), rays.array)
    if hasFar then WholeFile.write(input.resolve(s"$name.far"), far.array)
    val out = folder.resolve("embree.txt")
    val words = Vector(python, s"$script", s"$input", s"$out", s"${HitDistances.Allowed}")
    val outcome = commands.run(words, out, Timeout)
    for file <- Seq("mesh", "rays", "far") do
      val _ = Files.deleteIfExists(input.resolve(s"$name.$file"))
    outcome match
      case Outcome.Done(_, _) =>
        Right(Files.readAllLines(out).asScala.head.split(' ').toVector.tail.map(_.toLong))
      case Outcome.Failed(why) => Left(why)
      case Outcome.Cancelled => Left("cancelled")

object EmbreeRays:
  val programs: Vector[RobustProgram] = Vector(
    RobustProgram("embree-fast", "Embree, fast", isOurs = false),
    RobustProgram("embree-robust", "Embree, robust", isOurs = false)
  )
  private final val Timeout = 600.0

  /** Rays of one run of the script. */
  private final val MaxRays = 1_000_000L

  private lazy val Resource: Array[Byte] =
    val stream = getClass.getResourceAsStream("/candela/bench/robustness/embree.py")
    try stream.readAllBytes
    finally stream.close()

  private def buffer(bytes: Int): ByteBuffer =
    ByteBuffer.allocate(bytes).order(ByteOrder.LITTLE_ENDIAN)

  private def mesh(soup: TriangleSoup): Array[Byte] =
    val points = 3 * soup.count
    val out = buffer(8 + 12 * points + 4 * points)
    out.putInt(points).putInt(soup.count)
    for i <- 0 until soup.count; k <- 0 until 3; p = soup.vertex(i, k); x <- Seq(p.x, p.y, p.z) do
      out.putFloat(x)
    for i <- 0 until points do out.putInt(i)
    out.array
