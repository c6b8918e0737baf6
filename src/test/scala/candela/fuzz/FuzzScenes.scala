package candela.fuzz

import java.lang.management.ManagementFactory
import java.nio.file.{Files, Path}
import scala.util.Random

/** Reads many broken files, and says which of them did not end in an answer or a clean refusal.
  *
  * Usage: `./sbt "Test/runMain candela.fuzz.FuzzScenes --kind scenes --count 1000000 --seed 1"`.
  * The options are in CONTRIBUTING.md. A file that is a finding stays in the folder that is named
  * at the start; so does the last one, should the process itself come to an end.
  */
object FuzzScenes:

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(key, value) => key -> value }.toMap
    val kinds = Kind.values.toVector.filter(k => options.get("--kind").forall(_ == k.name))
    val count = options.get("--count").fold(10000)(_.toInt)
    val seed = options.get("--seed").fold(1)(_.toInt)
    val seconds = options.get("--seconds").fold(10)(_.toInt)
    val from = Path.of(options.getOrElse("--from", "scenes"))
    val folder = Files.createTempDirectory("candela-fuzz")
    println(s"broken files of $from, in $folder")
    val times = ManagementFactory.getThreadMXBean
    val worker = Thread.currentThread
    def spent = times.getThreadCpuTime(worker.getId)
    @volatile var began = Long.MaxValue
    val watch = Thread: () =>
      while true do
        Thread.sleep(200)
        // processor time: the machine may have other things to do
        if spent > began && spent - began > seconds * 1000000000L then
          println(s"no answer within $seconds s to the newest file in $folder")
          worker.getStackTrace.take(25).foreach(line => println(s"    at $line"))
          Runtime.getRuntime.halt(2)
    watch.setDaemon(true)
    watch.start()
    var findings = 0
    for kind <- kinds do
      val trials = Trials(from, folder, Random(seed))
      val start = System.nanoTime()
      var slowest = 0L
      for i <- 0 until count do
        val file = trials.next(kind)
        began = spent
        for wrong <- trials.judge(kind, file) do
          findings += 1
          val kept = folder.resolve(s"finding-$findings-${file.getFileName}")
          val _ = Files.copy(file, kept)
          println(s"${kind.name} $i, kept as $kept: $wrong")
          if findings == 50 then sys.exit(1)
        slowest = slowest.max(spent - began)
        began = Long.MaxValue
      val time = (System.nanoTime() - start) / 1e9
      println(f"$count ${kind.name}: $time%.0f s, the slowest ${slowest / 1e6}%.0f ms")
    println(s"$findings findings")
    sys.exit(if findings == 0 then 0 else 1)
