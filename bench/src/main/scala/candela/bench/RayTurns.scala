package candela.bench

import java.io.File
import java.net.{URL, URLClassLoader}
import java.util.function.ToLongFunction

/** Compares kernels that were compiled at different times, in one program: each is loaded from a
  * class path of its own, and they take turns of 20,000 rays, so that what else the machine does is
  * the same for all. Of each part the best turn counts.
  *
  * Arguments are `NAME=KERNEL=CLASSPATH`, the folders of classes that come before those of this
  * program; options `--triangles N` `--side N` `--seconds S` (for each kernel and set) `--only SET`.
  */
object RayTurns:
  def main(args: Array[String]): Unit =
    val (named, options) = args.toSeq.partition(_.count(_ == '=') == 2)
    val set = options.grouped(2).collect { case Seq(k, v) => k -> v }.toMap
    def number(name: String, default: Int) = set.get(s"--$name").fold(default)(_.toInt)
    val own = System.getProperty("java.class.path")
    val turns = named.map: text =>
      val Array(name, kernel, path) = text.split("=", 3): @unchecked
      val urls = (path + File.pathSeparator + own).split(File.pathSeparator).map(url)
      val loader = URLClassLoader(urls, ClassLoader.getPlatformClassLoader)
      val made = loader
        .loadClass("candela.bench.RayTurn")
        .getConstructors()(0)
        .newInstance(kernel, number("triangles", 280000), number("side", 700))
      name -> made.asInstanceOf[ToLongFunction[Array[Int]]]
    val java = Runtime.version.feature
    val sets = Seq("camera", "bounce", "shadow")
    for (setName, i) <- sets.zipWithIndex if set.get("--only").forall(_ == setName) do
      val rates = measure(turns.map(_._2), i, number("seconds", 4))
      for ((name, _), (rate, sum)) <- turns.zip(rates) do
        val ratio = rate / rates.head._1
        println(f"java $java\t$name\t$setName\t$rate%.3f\t$ratio%.3f\t$sum%.1f")

  private def url(path: String): URL = File(path).toURI.toURL

  /** Million rays a second, and the sum of what was met in the last pass, for each. */
  private def measure(
      turns: Seq[ToLongFunction[Array[Int]]],
      set: Int,
      seconds: Int
  ): Seq[(Double, Double)] =
    val count = turns.head.applyAsLong(Array(set)).toInt
    val parts = (count + Part - 1) / Part
    val best = turns.map(_ => Array.fill(parts)(Long.MaxValue))
    val sums = Array.ofDim[Double](turns.length)
    val start = System.nanoTime
    val end = 2e9 * seconds * turns.length
    var isWarm = false
    while System.nanoTime - start < end do
      // The first half is to compile
      if !isWarm && System.nanoTime - start > end / 2 then isWarm = true
      for t <- turns do t.applyAsLong(Array()): Unit
      for p <- 0 until parts; (t, k) <- turns.zipWithIndex do
        val time = t.applyAsLong(Array(set, p * Part, Math.min(count, (p + 1) * Part)))
        if isWarm && time < best(k)(p) then best(k)(p) = time
      for (t, k) <- turns.zipWithIndex do
        sums(k) = java.lang.Double.longBitsToDouble(t.applyAsLong(Array()))
    best.zip(sums).map((b, sum) => (count / (b.sum * 1e-9) * 1e-6, sum))

  private inline val Part = 20000
