package candela.cli

import candela.base.WholeFile
import candela.film.{Development, Film}
import candela.image.Image
import candela.measure.Errors
import candela.render.{ExpectedEnd, Pass, RenderPlan, PassObserver}

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path

/** Observes a rendering after 1, 2, 4, 8, … samples per pixel and at its end, beside another. */
private[cli] abstract class ChainedObserver(other: Option[PassObserver]) extends PassObserver:
  protected def saw(pass: Pass, film: Film): Unit

  override final def begins(samples: Int, film: Film): Unit =
    other.foreach(_.begins(samples, film))
  override final def isEnough: Boolean = other.exists(_.isEnough)
  override final def isOver(seconds: Double, still: Double): Boolean =
    other.exists(_.isOver(seconds, still))
  override final def seesWaves: Boolean = other.exists(_.seesWaves)
  override final def most: Int = other.fold(Int.MaxValue)(_.most)
  override final def goal: Option[ExpectedEnd] = other.flatMap(_.goal)
  override final def errorAt(samples: Double): Option[Double] = other.flatMap(_.errorAt(samples))

  final def passed(pass: Pass, film: Film): Unit =
    other.foreach(_.passed(pass, film))
    if pass.isLast || Integer.bitCount(pass.samples) == 1 then saw(pass, film)

/** Writes lines of samples per pixel and MSE, as pbrt-v4 does. */
private[cli] final class ErrorLog(
    development: Development,
    reference: Image,
    file: Path,
    other: Option[PassObserver]
) extends ChainedObserver(other):
  private val lines = StringBuilder()

  protected def saw(pass: Pass, film: Film): Unit =
    val mse = Errors.quickly(reference)(development(film)).mse
    lines ++= s"${pass.samples}, ${Figures.general(mse)}\n"
    WholeFile.write(file, lines.toString.getBytes(UTF_8))

private[cli] object ErrorLog:
  /** None unless the plan asks for one. */
  def of(plan: RenderPlan, other: Option[PassObserver]): Option[PassObserver] =
    plan.errors.map: asked =>
      val reference = RenderRecorder.fitting(plan, asked.reference)
      ErrorLog(plan.development, reference, OutputFiles.path(asked.file), other)

/** Writes the image of each pass but the last, which is written anyway. */
private[cli] final class PartialImages(write: () => Unit, other: Option[PassObserver])
    extends ChainedObserver(other):
  protected def saw(pass: Pass, film: Film): Unit = if !pass.isLast then write()
