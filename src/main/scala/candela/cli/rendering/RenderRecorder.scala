package candela.cli.rendering

import candela.base.Figures
import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.InputFile
import candela.cli.files.OutputFiles
import candela.film.Development
import candela.image.{Image, ImageFiles}
import candela.job.ErrorRecorder
import candela.measure.{ErrorLayer, PixelWindow}
import candela.render.{Pass, RenderPlan}
import candela.report.{PassSpan, Picture}

/** Measures errors, and keeps what reports show: passes and pictures.
  *
  * @param reference same size as the image; None: errors are estimated from the noise
  */
final class RenderRecorder(development: Development, val reference: Option[Image])
    extends ErrorRecorder(development, reference):
  private val foundPasses = Vector.newBuilder[PassSpan]
  private var first, last: Option[(Image, Int)] = None

  def passes: Vector[PassSpan] = foundPasses.result()

  /** The final image, the first pass, and the reference. */
  def pictures: Vector[Picture] =
    def named(i: (Image, Int)) = Picture(Figures.count(i._2, "sample"), i._1)
    val firstPass = first.filter(f => last.exists(_._2 != f._2))
    last.map(named).toVector ++ firstPass.map(named) ++
      reference.map(r => Picture("reference", r.toRgb, isReference = true))

  override protected def measured(pass: Pass, image: => Image): Unit =
    val current = image
    foundPasses += PassSpan(pass.samples, pass.beginSeconds, pass.endSeconds, pass.workers)
    if first.isEmpty then first = Some((current, pass.samples))
    last = Some((current, pass.samples))

object RenderRecorder:

  def of(plan: RenderPlan, reference: Option[String]): RenderRecorder =
    RenderRecorder(plan.development, reference.map(fitting(plan, _)))

  /** Reads the reference, with its own error if it has it, and crops it to the plan's crop window.
    *
    * @throws SceneError if its size differs from the image's
    */
  def fitting(plan: RenderPlan, name: String): Image =
    val file = OutputFiles.path(name)
    // It may be read more than once, and a scene may have named it
    for why <- InputFile.obstacle(file) do
      throw SceneError(Problem.general(Code.Unreadable, s"can't read the reference `$name`: $why"))
    val image = ErrorLayer.extract(ImageFiles.read(file))
    val crop = plan.crop
    def isSize(width: Int, height: Int) = image.width == width && image.height == height
    if isSize(crop.width, crop.height) then image
    else if isSize(plan.width, plan.height) then
      PixelWindow(crop.x0, crop.x1, crop.y0, crop.y1).of(image)
    else
      val actual = s"${image.width}×${image.height}"
      val wanted = s"${plan.width}×${plan.height}"
      throw SceneError(Problem.general(
        Code.DifferentImages,
        s"reference `$name` must be $wanted pixels, found $actual"
      ))
