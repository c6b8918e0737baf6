package candela.jmh

import java.io.{BufferedOutputStream, OutputStream}
import java.lang.management.ManagementFactory
import java.nio.file.{Files, Path}
import java.nio.{ByteBuffer, ByteOrder}

import candela.accel.{Accelerator, BruteForce, Primitives}
import candela.accel.tracing.{Bvh, Grid, Hierarchies}
import candela.shapes.TriangleSoup

/** How many rays a second each kernel answers on one thread, in seconds of processor time.
  *
  * Options: `--triangles N` `--side N` (rays of the camera: N²) `--seconds S` (for each figure)
  * `--kernels a,b` `--files FOLDER` (writes the mesh and the rays there, for other programs).
  */
object RayKernels:
  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(k, v) => k -> v }.toMap
    def number(name: String, default: String) = options.getOrElse(s"--$name", default).toDouble
    val soup = RayMesh(number("triangles", "280000").toInt)
    val primitives = RayMesh.primitives(soup)
    val all = kernels(primitives)
    val chosen = options.get("--kernels").fold(all): names =>
      names.split(',').toSeq.flatMap(n => all.filter(_._1 == n))
    val built = chosen.map: (name, make) =>
      val start = cpu()
      val made = make()
      println(f"# $name: ${made.describe}, built in ${(cpu() - start) * 1e-9}%.2f s")
      (name, made)
    val sets = RaySet.all(soup, built.head._2, number("side", "700").toInt)
    for folder <- options.get("--files") do write(Path.of(folder), soup, sets)
    val java = Runtime.version.feature
    for set <- sets; (name, accelerator) <- built do
      val m = measure(accelerator, set, number("seconds", "3"))
      println(
        f"java $java\t$name\t${set.name}\t${m.rate}%.3f\t${m.hits}\t${m.sum}%.1f\t${m.bytes}%.2f"
      )

  def kernels(primitives: Primitives): Seq[(String, () => Accelerator)] =
    val vector =
      if Hierarchies.hasVectors then
        Seq("vector" -> (() => Hierarchies.vector(primitives, atOnce = true)))
      else Nil
    val few =
      if primitives.count > 10000 then Nil else Seq("brute" -> (() => BruteForce(primitives)))
    vector ++ Seq(
      "scalar4" -> (() => Hierarchies.scalar(primitives)),
      "scalar8" -> (() => Hierarchies.scalar(primitives, width = 8)),
      "binary" -> (() => Bvh(primitives)),
      "grid" -> (() => Grid(primitives))
    ) ++ few

  private def cpu(): Long = ManagementFactory.getThreadMXBean.getCurrentThreadCpuTime

  final class Measured(val rate: Double, val hits: Int, val sum: Double, val bytes: Double)

  /** The best pass of those within `seconds`, after as long a time to warm up. */
  private def measure(a: Accelerator, set: RaySet, seconds: Double): Measured =
    val pass = RayPass(a, set)
    def run() =
      pass.clear()
      pass.run(0, set.count)
    val begin = cpu()
    while cpu() - begin < seconds * 1e9 do run()
    var best = Double.PositiveInfinity
    val start = cpu()
    val beans = ManagementFactory.getThreadMXBean.asInstanceOf[com.sun.management.ThreadMXBean]
    val thread = Thread.currentThread.getId
    val before = beans.getThreadAllocatedBytes(thread)
    var passes = 0
    while cpu() - start < seconds * 1e9 do
      val from = cpu()
      run()
      passes += 1
      best = Math.min(best, (cpu() - from) * 1e-9)
    val bytes = (beans.getThreadAllocatedBytes(thread) - before).toDouble / passes / set.count
    Measured(set.count / best * 1e-6, pass.hits, pass.sum, bytes)

  private def write(folder: Path, soup: TriangleSoup, sets: Seq[RaySet]): Unit =
    Files.createDirectories(folder): Unit
    file(folder.resolve("mesh.bin")): out =>
      ints(out, Array(soup.positions.length / 3, soup.count))
      floats(out, soup.positions)
      ints(out, soup.indices.slice(0, soup.indices.length))
    for set <- sets do
      file(folder.resolve(s"${set.name}.bin")): out =>
        ints(out, Array(set.count, if set.anyHit then 1 else 0))
        floats(out, set.floats)

  private def file(path: Path)(body: OutputStream => Unit): Unit =
    val out = BufferedOutputStream(Files.newOutputStream(path), 1 << 16)
    try body(out)
    finally out.close()

  private def ints(out: OutputStream, all: Array[Int]): Unit =
    val bytes = ByteBuffer.allocate(4 * all.length).order(ByteOrder.LITTLE_ENDIAN)
    bytes.asIntBuffer.put(all)
    out.write(bytes.array)

  private def floats(out: OutputStream, all: Array[Float]): Unit =
    ints(out, all.map(java.lang.Float.floatToRawIntBits))
