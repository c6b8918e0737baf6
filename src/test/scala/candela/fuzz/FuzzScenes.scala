package candela.fuzz

import java.lang.management.ManagementFactory
import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.file.{Files, Path, StandardOpenOption}
import java.util.concurrent.atomic.AtomicInteger
import scala.util.Random

/** Gives the program much hostile input, and says which of it did not end in an answer or a clean
  * refusal.
  *
  * Usage: `./sbt "Test/runMain candela.fuzz.FuzzScenes --kind scenes --count 1000000 --seed 1"`.
  * The options are in docs/TESTING.md. The files of a finding stay in the folder that is named at
  * the start; so do the last ones, should the process itself come to an end.
  */
object FuzzScenes:

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(key, value) => key -> value }.toMap
    val kinds = Kind.all.filter(k => options.get("--kind").forall(_ == k.name))
    val seed = options.get("--seed").fold(1)(_.toInt)
    val threads = options.get("--threads").fold(1)(_.toInt)
    val from = Path.of(options.getOrElse("--from", "scenes"))
    val base = Path.of(options.getOrElse("--folder", System.getProperty("java.io.tmpdir")))
    val folder = Files.createTempDirectory(base, "candela-fuzz")
    println(s"of $from, in $folder")
    var findings = 0
    for kind <- kinds do
      def place(thread: Int) =
        val own = if thread == 0 then folder else folder.resolve(s"thread-$thread")
        Place(from, Files.createDirectories(own), Random(seed + thread))
      val count = options.get("--count").fold(kind.usual)(_.toInt)
      val campaign = Campaign(kind, count, options.get("--seconds").fold(10)(_.toInt))
      findings += campaign.run(threads, place)
    println(s"$findings findings")
    sys.exit(if findings == 0 then 0 else 1)

/** Attempts of one kind, by several threads: each has its own files and random numbers. */
private final class Campaign(kind: Kind, count: Int, seconds: Int):
  private val begun, findings = AtomicInteger()
  private val watches = java.util.concurrent.ConcurrentLinkedQueue[Watch]()
  private val start = System.nanoTime()
  private val used = Watch.spentByAll

  /** The number of findings. */
  def run(threads: Int, place: Int => Place): Int =
    val all = Vector.tabulate(threads): i =>
      val own = place(i)
      val thread = Thread(() => attempts(own), s"fuzz-$i")
      thread.start()
      thread
    var next = start + Campaign.Interval
    while all.exists(_.isAlive) do
      all.find(_.isAlive).foreach(_.join(1000))
      if System.nanoTime() >= next then
        next += Campaign.Interval
        println(summary)
    println(summary)
    findings.get

  private def summary: String =
    val time = (System.nanoTime() - start) / 1e9
    val cpu = (Watch.spentByAll - used) / 1e9
    val done = Math.min(begun.get, count)
    var slowest = 0L
    watches.forEach(w => slowest = slowest.max(w.slowest))
    f"$done ${kind.name}: $time%.0f s, $cpu%.0f s of processor, ${done / time}%.0f a second, " +
      f"the slowest ${slowest / 1e6}%.0f ms; ${findings.get} findings"

  private def attempts(place: Place): Unit =
    kind.start(place) match
      case Left(why) => println(s"no ${kind.name}: $why")
      case Right(attempts) =>
        try this.attempts(attempts, place.folder)
        catch
          case e: Throwable =>
            failed(s"the fuzzer: $e", e.getStackTrace.take(20).mkString("\n")): Unit
        finally attempts.close()

  private def failed(what: String, wrong: String): Int =
    val n = findings.incrementAndGet()
    println(s"${kind.name}: $what\n  $wrong")
    n

  private def attempts(attempts: Attempts, folder: Path): Unit =
    val watch = Watch(seconds)
    watches.add(watch)
    val last = LastAttempt(folder)
    while begun.getAndIncrement() < count && findings.get < Campaign.MaxFindings do
      val attempt = attempts.next()
      last.set(attempt.what)
      watch.during(attempt.what)(attempt.judge()).foreach: wrong =>
        val n = failed(attempt.what, wrong)
        for file <- attempt.files if Files.isRegularFile(file) do
          val kept = folder.resolve(s"finding-${kind.name}-$n-${file.getFileName}")
          val _ = Files.copy(file, kept)
          println(s"  kept as $kept")

private object Campaign:
  private val MaxFindings = 50
  private val Interval = 10_000_000_000L

/** A file that tells the last attempt: native code may end the process. */
private final class LastAttempt(folder: Path):
  private val file = FileChannel.open(
    folder.resolve("last-attempt"),
    StandardOpenOption.CREATE,
    StandardOpenOption.WRITE
  )

  def set(what: String): Unit =
    val bytes = ByteBuffer.wrap(s"$what\n\n".getBytes("UTF-8"))
    file.write(bytes, 0): Unit

/** Ends the process if one attempt takes too long.
  *
  * @param seconds processor time, or six times as long without
  */
private final class Watch(seconds: Int):
  private val times = ManagementFactory.getThreadMXBean
  private val worker = Thread.currentThread
  private def spent = times.getThreadCpuTime(worker.getId)
  @volatile private var attempt = ""
  @volatile private var began = Long.MaxValue
  @volatile private var number, most = 0L

  private val watching = Thread: () =>
    var last = 0L
    var ticks = 0
    while true do
      Thread.sleep(Watch.Tick)
      ticks = if number == last then ticks + 1 else 0
      last = number
      // Mostly processor time: the machine may have other things to do. Ticks instead of a clock:
      // the process may be stopped for a while
      val isLate = began != Long.MaxValue &&
        (spent - began > seconds * 1_000_000_000L || ticks * Watch.Tick > 6000L * seconds)
      if isLate then
        println(s"no answer within $seconds s to $attempt")
        worker.getStackTrace.take(25).foreach(line => println(s"    at $line"))
        Runtime.getRuntime.halt(2)
  watching.setDaemon(true)
  watching.start()

  /** Longest processor time of an attempt, in nanoseconds. */
  def slowest: Long = most

  def during[A](what: String)(body: => A): A =
    attempt = what
    number += 1
    began = spent
    try body
    finally
      most = most.max(spent - began)
      began = Long.MaxValue

private object Watch:
  /** In milliseconds. */
  private val Tick = 200L

  /** Processor time of this process, in nanoseconds; of its children nothing is known. */
  def spentByAll: Long = ManagementFactory.getOperatingSystemMXBean match
    case system: com.sun.management.OperatingSystemMXBean => system.getProcessCpuTime
    case _ => 0
