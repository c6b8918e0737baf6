package candela.bench.suite

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** Peak memory of running programs, where the operating system tells it: on Linux. */
private[suite] object PeakMemory:

  /** Peak resident memory in bytes so far, of `process` or of that process among its descendants
    * which needs most; None if unknown, for example because it has ended.
    *
    * Source: proc(5), `VmHWM`.
    */
  def of(process: ProcessHandle): Option[Long] =
    val all = process +: process.descendants.iterator.asScala.toVector
    all.flatMap(p => ofStatus(Path.of("/proc", p.pid.toString, "status"))).maxOption

  private def ofStatus(file: Path): Option[Long] =
    Try(Files.readString(file)).toOption
      .flatMap(_.linesIterator.collectFirst { case s"VmHWM:$size kB" => size.trim.toLong * 1024 })
