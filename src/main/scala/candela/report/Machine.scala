package candela.report

import java.lang.management.ManagementFactory
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** What figures were measured on: without it they mean nothing.
  *
  * @param load of the system when measuring began (1-minute average), if it is told; well below 1
  *             on a machine that did nothing else
  */
final case class Machine(
    processor: String,
    cores: Int,
    memoryBytes: Long,
    system: String,
    java: String,
    load: Option[Double]
):
  def rows: Vector[(String, String)] = Vector(
    "processor" -> processor,
    "hardware threads" -> cores.toString,
    "memory" -> f"${memoryBytes / 1e9}%.0f GB",
    "system" -> system,
    "Java" -> java
  ) ++ load.map(l => "load at the start" -> "%.2f".formatLocal(_root_.java.util.Locale.ROOT, l))

object Machine:

  def here(): Machine =
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

  /** Linux tells; elsewhere Java knows the architecture alone. */
  private def processorName: Option[String] = Try:
    Files.readAllLines(Path.of("/proc/cpuinfo")).asScala
      .collectFirst { case s"model name$_: $name" => name.trim }
  .toOption.flatten

  private def memory: Long = Try:
    Files.readAllLines(Path.of("/proc/meminfo")).asScala
      .collectFirst { case s"MemTotal:$kilobytes kB" => kilobytes.trim.toLong * 1024 }
  .toOption.flatten.getOrElse(Runtime.getRuntime.maxMemory)
