package candela.stability

import java.lang.management.ManagementFactory
import java.nio.file.Path

import candela.bench.robustness.Trials

/** The cases of the stability suites with their long counts, which take minutes to hours:
  * {{{
  * ./sbt "Test/runMain candela.stability.LongRun --case words of its name --count 1000000"
  * }}}
  * Without `--case` all are run; without `--count` each as often as it says.
  *
  * With `--slice 1000000` the cases are taken in turn, each a million trials with random numbers of
  * their own at a time, so that what is stopped has done the same of each. `--record FILE` writes a
  * line after each slice, and goes on behind those that are there. `--minutes 60` begins no slice
  * after that. `--table FILE` only prints what a record sums up to.
  */
object LongRun:
  private val groups: Seq[Group] =
    Seq(SelfIntersection, Intersections, Scattering, Lighting, Accumulation, Sampling)

  def main(args: Array[String]): Unit =
    def option(name: String) =
      val at = args.indexOf(name)
      Option.when(at >= 0)(args.drop(at + 1).takeWhile(!_.startsWith("--")).mkString(" "))
    val wanted = option("--case").getOrElse("")
    val chosen =
      groups.flatMap(_.cases).filter(c => c.name.contains(wanted) || c.kind.contains(wanted))
    option("--table") match
      case Some(file) => print(LongRecord(Path.of(file)).table(groups.flatMap(_.cases)))
      case None =>
        val run = LongRun(
          chosen,
          option("--count").map(_.toLong),
          option("--slice").map(_.toLong),
          option("--record").map(file => LongRecord(Path.of(file))),
          option("--minutes").fold(Double.PositiveInfinity)(_.toDouble)
        )
        run.all()

private final class LongRun(
    cases: Seq[Case],
    asked: Option[Long],
    sliceSize: Option[Long],
    record: Option[LongRecord],
    minutes: Double
):
  private val started = System.nanoTime
  private val clock = ManagementFactory.getThreadMXBean
  private var failures = 0

  private def count(c: Case): Long = asked.getOrElse(c.long)
  private def size(c: Case): Long = if c.isSliced then sliceSize.getOrElse(count(c)) else count(c)
  private def slices(c: Case): Int = ((count(c) + size(c) - 1) / size(c)).toInt
  private def isTime: Boolean = (System.nanoTime - started) / 60e9 < minutes

  def all(): Unit =
    val done = record.fold(Map.empty[String, Int])(_.slices)
    var k = 0
    while k < cases.map(slices).maxOption.getOrElse(0) do
      for c <- cases if k < slices(c) && k >= done.getOrElse(c.name, 0) && isTime do take(c, k)
      k += 1
    println(if failures == 0 then "all passed" else s"$failures failed")
    if failures > 0 then throw IllegalStateException(s"$failures slices of cases failed")

  private def take(c: Case, k: Int): Unit =
    val trials = Trials(Math.min(size(c), count(c) - k * size(c)), k)
    val before = clock.getCurrentThreadCpuTime
    val failure =
      try
        c.check(trials)
        None
      catch case e: org.scalatest.exceptions.TestFailedException => Some(e.getMessage)
    val seconds = (clock.getCurrentThreadCpuTime - before) * 1e-9
    record.foreach(_.add(LongRecord.Line(c.name, k, trials.count, seconds, failure.isEmpty)))
    val part = if slices(c) > 1 then s", slice ${k + 1} of ${slices(c)}" else ""
    val word = if failure.isEmpty then "ok    " else "FAILED"
    println(f"$word ${c.name}: ${trials.count} trials$part, $seconds%.1f s")
    for message <- failure do
      failures += 1
      println(s"       $message")
