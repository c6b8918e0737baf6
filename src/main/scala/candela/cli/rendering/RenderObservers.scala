package candela.cli.rendering

import candela.base.Figures
import candela.diagnostics.Problem
import candela.io.WholeFile
import candela.cli.files.OutputFiles
import candela.film.{Development, Film}
import candela.image.Image
import candela.measure.Errors
import candela.render.{Live, Looks, Pass, RenderListener, Rendering, RenderPlan}

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path

/** Writes lines of samples per pixel and MSE, as pbrt-v4 does. */
private[cli] final class ErrorLog(development: Development, reference: Image, file: Path)
    extends RenderListener:
  private val lines = StringBuilder()
  private var failures = Vector.empty[Problem]
  private var unresolved = 0

  override def frequency: Looks = Looks.Doublings

  override def passed(pass: Pass, film: Film): Unit =
    val errors = Errors.quickly(reference)(development(film))
    if errors.isUnresolved then unresolved += 1
    lines ++= s"${pass.samples}, ${Figures.general(errors.mse)}\n"
    failures =
      OutputFiles.failures(Vector(file))(WholeFile.write(_, lines.toString.getBytes(UTF_8)))
        .map(_._2)

  /** Which lines the reference's own error, which is subtracted, leaves nothing of. */
  def remark: Option[String] = Option.when(unresolved > 0):
    val lines = Figures.count(unresolved, "line")
    s"$lines of $file: the MSE is below the reference's own, and shown as 0"

  /** Why the last lines could not be written. */
  def failure: Vector[Problem] = failures

private[cli] object ErrorLog:
  /** None unless the plan asks for one. */
  def of(plan: RenderPlan): Option[ErrorLog] =
    plan.errors.map: asked =>
      val reference = RenderRecorder.fitting(plan, asked.reference)
      ErrorLog(plan.development, reference, OutputFiles.path(asked.file))

/** Writes the image of each pass but the last, which is written anyway. */
private[cli] final class PartialImages(write: Rendering => Unit) extends RenderListener:
  private var live = Option.empty[Live]

  override def started(live: Live): Unit = this.live = Some(live)

  override def frequency: Looks = Looks.Doublings

  override def passed(pass: Pass, film: Film): Unit =
    if !pass.isLast then live.foreach(l => write(l.rendering))
