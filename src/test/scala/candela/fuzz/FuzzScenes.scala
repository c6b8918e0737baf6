package candela.fuzz

import java.lang.management.ManagementFactory
import java.nio.file.{Files, Path}
import scala.util.Random

/** Gives the program much hostile input, and says which of it did not end in an answer or a clean
  * refusal.
  *
  * Usage: `./sbt "Test/runMain candela.fuzz.FuzzScenes --kind scenes --count 1000000 --seed 1"`.
  * The options are in CONTRIBUTING.md. The files of a finding stay in the folder that is named at
  * the start; so do the last ones, should the process itself come to an end.
  */
object FuzzScenes:

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(key, value) => key -> value }.toMap
    val kinds = Kind.all.filter(k => options.get("--kind").forall(_ == k.name))
    val seed = options.get("--seed").fold(1)(_.toInt)
    val from = Path.of(options.getOrElse("--from", "scenes"))
    val base = Path.of(options.getOrElse("--folder", System.getProperty("java.io.tmpdir")))
    val folder = Files.createTempDirectory(base, "candela-fuzz")
    println(s"of $from, in $folder")
    val watch = Watch(options.get("--seconds").fold(10)(_.toInt))
    var findings = 0
    for kind <- kinds do
      kind.start(Place(from, folder, Random(seed))) match
        case Left(why) => println(s"no ${kind.name}: $why")
        case Right(attempts) =>
          val count = options.get("--count").fold(kind.usual)(_.toInt)
          try findings += run(kind, attempts, count, folder, watch)
          finally attempts.close()
    println(s"$findings findings")
    sys.exit(if findings == 0 then 0 else 1)

  private def run(
      kind: Kind,
      attempts: Attempts,
      count: Int,
      folder: Path,
      watch: Watch
  ): Int =
    val start = System.nanoTime()
    val used = Watch.spentByAll
    var findings = 0
    var i = 0
    while i < count && findings < MostFindings do
      val attempt = attempts.next()
      // Native code may end the process
      val _ = Files.write(folder.resolve("last-attempt"), attempt.what.getBytes("UTF-8"))
      watch.during(attempt.what)(attempt.judge()).foreach: wrong =>
        findings += 1
        println(s"${kind.name} $i: ${attempt.what}\n  $wrong")
        for file <- attempt.files if Files.isRegularFile(file) do
          val kept = folder.resolve(s"finding-${kind.name}-$findings-${file.getFileName}")
          val _ = Files.copy(file, kept)
          println(s"  kept as $kept")
      i += 1
    val time = (System.nanoTime() - start) / 1e9
    val cpu = (Watch.spentByAll - used) / 1e9
    println(
      f"$i ${kind.name}: $time%.0f s, $cpu%.0f s of processor, ${i / time}%.0f a second, " +
        f"the slowest ${watch.slowest / 1e6}%.0f ms; $findings findings"
    )
    findings

  private val MostFindings = 50

/** Ends the process if one attempt takes too long.
  *
  * @param seconds processor time, or six times as long without
  */
private final class Watch(seconds: Int):
  private val times = ManagementFactory.getThreadMXBean
  private val worker = Thread.currentThread
  private def spent = times.getThreadCpuTime(worker.getId)
  @volatile private var attempt = ""
  @volatile private var began, begin = Long.MaxValue
  private var most = 0L

  private val watching = Thread: () =>
    while true do
      Thread.sleep(200)
      // Mostly processor time: the machine may have other things to do
      val limit = seconds * 1_000_000_000L
      val isLate = (spent > began && spent - began > limit) ||
        (System.nanoTime > begin && System.nanoTime - begin > 6 * limit)
      if isLate then
        println(s"no answer within $seconds s to $attempt")
        worker.getStackTrace.take(25).foreach(line => println(s"    at $line"))
        Runtime.getRuntime.halt(2)
  watching.setDaemon(true)
  watching.start()

  /** Longest processor time of an attempt since it was last asked, in nanoseconds. */
  def slowest: Long =
    val last = most
    most = 0
    last

  def during[A](what: String)(body: => A): A =
    attempt = what
    began = spent
    begin = System.nanoTime
    try body
    finally
      most = most.max(spent - began)
      began = Long.MaxValue
      begin = Long.MaxValue

private object Watch:
  /** Processor time of this process, in nanoseconds; of its children nothing is known. */
  def spentByAll: Long = ManagementFactory.getOperatingSystemMXBean match
    case system: com.sun.management.OperatingSystemMXBean => system.getProcessCpuTime
    case _ => 0
