package candela.bench.robustness

import candela.base.Version
import java.nio.file.Path
import java.time.LocalDateTime
import java.time.format.DateTimeFormatter

import candela.bench.report.{RobustGroup, RobustnessReport, RobustRow}
import candela.bench.suite.{Commands, Installed}
import candela.render.{Cancellation, ThreadPool}
import candela.report.Machine

/** Measures numerical robustness: of Candela, and of other programs that are there.
  *
  * @param rays    trials of each row
  * @param python  a Python that has embreex, if not that of [[Installed]]
  * @param scratch folder for scenes and images
  * @param command command line that makes the same report
  * @param onRow     receives each row when it is measured, with its group
  */
final class RobustnessRun(
    rays: Long,
    measurements: Vector[Measurement],
    threads: Int,
    python: Option[String],
    scratch: Path,
    command: String,
    cancellation: Cancellation,
    onRow: (RobustGroup, RobustRow) => Unit
):
  private val commands = Commands(Vector.empty, scratch, () => cancellation.isRequested)
  private val kernels = Kernel.all
  private val installed = Installed(sys.env ++ python.map(Installed.Python -> _))
  private val (otherPainters, absentPainters) =
    OtherPainter.detect(scratch, commands, threads, installed)
  private val painters = OwnPainter(threads, cancellation) +: otherPainters
  private val noEmbree = installed.library("Embree", "embreex", "numpy")
  private val embree =
    Option.when(noEmbree.isEmpty)(EmbreeRays(installed.python, scratch, commands))

  /** Programs that can't be asked, and why. */
  val leftOut: Vector[(String, String)] =
    Kernel.missing ++ absentPainters ++ noEmbree.map(a => a.title -> a.obtain)

  def report(): RobustnessReport =
    val machine = Machine.current()
    val begun = LocalDateTime.now.format(DateTimeFormatter.ofPattern("yyyy-MM-dd HH:mm"))
    val started = System.nanoTime
    val pool = ThreadPool(threads, worksAside = false)
    val groups =
      try
        val equipment =
          Equipment(rays, pool, kernels, painters, embree, () => cancellation.isRequested)
        measurements.map(group(_, equipment))
      finally pool.close()
    val programs = kernels.map(_.program) ++ painters.take(1).map(_.program) ++
      embree.toVector.flatMap(_ => EmbreeRays.programs) ++ painters.drop(1).map(_.program)
    RobustnessReport(
      Version.current,
      machine,
      begun,
      (System.nanoTime - started) * 1e-9,
      rays,
      command,
      programs,
      groups.filter(_.rows.nonEmpty),
      leftOut
    )

  private def group(m: Measurement, by: Equipment): RobustGroup =
    val empty = RobustGroup(m.key, m.title, m.per, m.words, Vector.empty)
    val rows = m.rows(by).takeWhile(_ => !cancellation.isRequested).map: row =>
      onRow(empty, row)
      row
    empty.copy(rows = rows.toVector)

object RobustnessRun:
  /** All measurements, in the order of the report. */
  val all: Vector[Measurement] =
    Vector(Leaks, Distances, SelfHits, NearLights, BadScattering, Terminators, Bumps, Extremes)
