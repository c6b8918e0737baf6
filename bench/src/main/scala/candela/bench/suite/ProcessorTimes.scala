package candela.bench.suite

import java.nio.file.{Files, Path}

import scala.util.Try

/** Processor time since the system started, in its ticks. Where a machine is busy with other things
  * than a benchmark, times are too long.
  *
  * Source: proc(5), `/proc/stat` and `/proc/self/stat`.
  *
  * @param all  of all processors, idle or not
  * @param busy of programs and the system, and what a hypervisor gave to other machines
  * @param own  of this program, and of those that it started and that have ended
  */
private[suite] final case class ProcessorTimes(all: Long, busy: Long, own: Long):

  /** Share of the processors that others took from then to now. */
  def othersSince: Option[Double] = ProcessorTimes.current.flatMap(othersUntil)

  /** None: too short a time. */
  def othersUntil(later: ProcessorTimes): Option[Double] =
    val ticks = later.all - all
    Option.when(ticks > 0):
      val otherTicks = later.busy - busy - (later.own - own)
      Math.min(1, Math.max(0, otherTicks.toDouble / ticks))

private[suite] object ProcessorTimes:

  /** None where the system doesn't tell. */
  def current: Option[ProcessorTimes] = Try:
    of(Files.readString(Path.of("/proc/stat")), Files.readString(Path.of("/proc/self/stat")))
  .toOption

  /** @param machine, process contents of the two files */
  def of(machine: String, process: String): ProcessorTimes =
    val Array(user, nice, system, idle, waiting, irq, softIrq, stolen) =
      machine.linesIterator.next().split(" +").slice(1, 9).map(_.toLong): @unchecked
    // The name of the program, in brackets, may have any characters.
    val fields = process.drop(process.lastIndexOf(')') + 2).split(' ')
    val busy = user + nice + system + irq + softIrq + stolen
    ProcessorTimes(busy + idle + waiting, busy, fields.slice(11, 15).map(_.toLong).sum)
