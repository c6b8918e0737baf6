package candela.fuzz

import java.nio.file.Files
import java.util.concurrent.TimeUnit
import scala.collection.mutable
import scala.jdk.CollectionConverters.*
import scala.util.Try

import candela.cli.KilledRenderings

/** The program in a process that is killed at a system call, or whose calls fail. */
final class KilledCalls private (place: Place) extends Attempts:
  import KilledCalls.*
  import place.random

  private val jobs = Job.all(place.folder.resolve("calls"), place.folder.resolve("killed"))
  private val log = place.folder.resolve("calls.log")

  /** How often a job calls what. */
  private val counts = mutable.HashMap.empty[Job, Map[String, Int]]

  private def counted(job: Job): Map[String, Int] =
    val traced = Vector("-o", log.toString, "-e", s"trace=${Calls.mkString(",")}")
    require(traces(traced, job).contains(0))
    // strace counts the calls of each thread for itself
    val lines = Files.readAllLines(log).asScala.toVector
    val calls = lines.flatMap("^(\\d+) +(\\w+)\\(".r.findFirstMatchIn(_))
    val each = calls.groupMapReduce(c => (c.group(1), c.group(2)))(_ => 1)(_ + _)
    each.toVector.groupMapReduce((key, _) => key._2)((_, n) => n)(_.max(_))

  def next(): Attempt =
    val job = jobs(random.nextInt(jobs.size))
    val each = counts.getOrElseUpdate(job, counted(job))
    val calls = each.keys.toVector.sorted
    val call = calls(random.nextInt(calls.size))
    val count = each(call)
    // The first calls are those of Java's start
    val at = count - random.nextInt(count.min(Latest))
    // Java can't do without what it opens
    val errors = if Fallible(call) then Vector("error=ENOSPC", "error=EIO") else Vector.empty
    val actions = "signal=KILL" +: errors
    val action = actions(random.nextInt(actions.size))
    val exists = random.nextInt(4) > 0
    val before = Option.when(exists)(job.versions(0))
    Attempt(
      s"${job.words(2).mkString(" ")}, $action at call $at of $call",
      Vector.empty,
      () => judged(job, before, s"$call:$action:when=$at", action.startsWith("error"))
    )

  private def judged(
      job: Job,
      before: Option[Array[Byte]],
      injected: String,
      goesOn: Boolean
  ): Option[String] =
    val _ = Files.deleteIfExists(job.file)
    before.foreach(Files.write(job.file, _))
    val call = injected.takeWhile(_ != ':')
    val code =
      traces(Vector("-o", "/dev/null", "-e", s"trace=$call", "-e", s"inject=$injected"), job)
    val wrong = code match
      case None => Some("it does not end")
      case Some(c) => Option.when(goesOn && c != 0 && c != 1)(s"exit code $c")
    wrong.orElse(job.broken(before)).orElse(job.next())

object KilledCalls:
  private val Opening = Vector("openat", "unlink", "unlinkat")
  private val Fallible =
    Set("write", "pwrite64", "fsync", "fdatasync", "rename", "renameat", "renameat2", "ftruncate")
  private val Calls = Opening ++ Fallible.toVector.sorted :+ "close"

  /** Calls of a kind that are tried, from the last one on. */
  private val Latest = 60

  def start(place: Place): Either[String, Attempts] =
    val finds = Try:
      val process = ProcessBuilder("strace", "-f", "-o", "/dev/null", "true").start()
      process.waitFor(10, TimeUnit.SECONDS) && process.exitValue == 0
    if finds.getOrElse(false) then Right(new KilledCalls(place))
    else Left("strace is not installed, or may trace nothing")

  /** Runs the second version of a job; its exit code. */
  private def traces(words: Vector[String], job: Job): Option[Int] =
    val command = Vector("strace", "-f", "-qq", "--seccomp-bpf") ++ words ++
      KilledRenderings.command(job.words(2))
    val builder = ProcessBuilder(command.asJava)
    val nowhere = ProcessBuilder.Redirect.DISCARD
    val process = builder.redirectOutput(nowhere).redirectError(nowhere).start()
    if process.waitFor(120, TimeUnit.SECONDS) then Some(process.exitValue)
    else
      val _ = process.destroyForcibly()
      None
