package candela.report

import java.lang.management.ManagementFactory
import java.nio.file.{Files, Path}
import java.util.Locale

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** The machine of a measurement, without which figures are meaningless.
  *
  * @param load system load when measuring began (1-minute average), if known; well below 1 on an
  *   otherwise idle machine
  */
final case class Machine(
    processor: String,
    cores: Int,
    memoryBytes: Long,
    system: String,
    java: String,
    load: Option[Double]
):
  /** What to say if it had other things to do than to be measured. */
  def business: Option[String] = load.filter(_ >= Machine.Busy).map: l =>
    s"the machine was busy when measuring began (load ${Numbers.fixed(l, 2)} on $cores hardware " +
      "threads): times are too long"

  def rows: Vector[(String, String)] = Vector(
    "processor" -> processor,
    "hardware threads" -> cores.toString,
    "memory" -> "%.0f GB".formatLocal(Locale.ROOT, memoryBytes / 1e9),
    "system" -> system,
    "Java" -> java
  ) ++ load.map(l => "load at the start" -> "%.2f".formatLocal(Locale.ROOT, l))

object Machine:

  /** Load that falsifies times: half a processor is busy. */
  private val Busy = 0.5

  def current(): Machine =
    def property(name: String) = System.getProperty(name, "?")
    val system = ManagementFactory.getOperatingSystemMXBean
    Machine(
      processorName.getOrElse(property("os.arch")),
      Runtime.getRuntime.availableProcessors,
      memory,
      s"${property("os.name")} ${property("os.version")}",
      s"${property("java.vm.name")} ${property("java.vm.version")}",
      Option(system.getSystemLoadAverage).filter(_ >= 0)
    )

  /** From /proc on Linux; elsewhere Java provides only the architecture. */
  private def processorName: Option[String] = Try:
    Files.readAllLines(Path.of("/proc/cpuinfo")).asScala
      .collectFirst { case s"model name$_: $name" => name.trim }
  .toOption.flatten

  private def memory: Long = Try:
    Files.readAllLines(Path.of("/proc/meminfo")).asScala
      .collectFirst { case s"MemTotal:$kilobytes kB" => kilobytes.trim.toLong * 1024 }
  .toOption.flatten.getOrElse(Runtime.getRuntime.maxMemory)
