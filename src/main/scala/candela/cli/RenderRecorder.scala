package candela.cli

import candela.base.{Problem, SceneError}
import candela.film.{Development, Film}
import candela.image.{Image, ImageFiles}
import candela.measure.{CurvePoint, Errors, PixelWindow}
import candela.render.{Pass, RenderPlan, Witness}
import candela.report.{PassSpan, Picture}

/** Measures the error of the image after each pass.
  *
  * @param reference same size as the image; None: errors are estimated from the noise
  */
final class RenderRecorder(development: Development, reference: Option[Image]) extends Witness:
  private val foundPoints = Vector.newBuilder[CurvePoint]
  private val foundPasses = Vector.newBuilder[PassSpan]
  private var first, last: Option[(Image, Int)] = None
  private var earlier: Option[(Film, Int)] = None
  private var spent = 0.0

  def points: Vector[CurvePoint] = foundPoints.result()
  def passes: Vector[PassSpan] = foundPasses.result()

  /** Time spent on measuring, in seconds. */
  def seconds: Double = spent

  /** The final image, the first pass, and the reference. */
  def pictures: Vector[Picture] =
    def named(i: (Image, Int)) = Picture(Figures.count(i._2, "sample"), i._1)
    val begin = first.filter(f => last.exists(_._2 != f._2))
    last.map(named).toVector ++ begin.map(named) ++
      reference.map(Picture("reference", _, isReference = true))

  override def begins(samples: Int, film: Film): Unit =
    if reference.isEmpty && samples > 0 then earlier = Some((film.copy(), samples))

  def passed(pass: Pass, film: Film): Unit =
    val started = System.nanoTime
    val image = development(film)
    val errors = reference match
      case Some(r) => Some(Errors.against(r)(image))
      case None => earlier.map: (before, samples) =>
          val added = development(film.since(before))
          Errors.ofParts(development(before), samples, added, pass.samples - samples)
    errors.foreach(e => foundPoints += CurvePoint(pass.samples, pass.end, e))
    foundPasses += PassSpan(pass.samples, pass.begin, pass.end, pass.workers)
    if reference.isEmpty then earlier = Some((film.copy(), pass.samples))
    if first.isEmpty then first = Some((image, pass.samples))
    last = Some((image, pass.samples))
    spent += (System.nanoTime - started) * 1e-9

object RenderRecorder:

  def of(plan: RenderPlan, reference: Option[String]): RenderRecorder =
    RenderRecorder(plan.development, reference.map(fitting(plan, _)))

  /** Reads the reference and crops it to the plan's crop window.
    *
    * @throws SceneError if its size differs from the image's
    */
  def fitting(plan: RenderPlan, name: String): Image =
    val image = ImageFiles.read(OutputFiles.path(name)).toRgb
    val crop = plan.crop
    def has(width: Int, height: Int) = image.width == width && image.height == height
    if has(crop.width, crop.height) then image
    else if has(plan.width, plan.height) then
      PixelWindow(crop.x0, crop.x1, crop.y0, crop.y1).of(image)
    else
      val found = s"${image.width}×${image.height}"
      val wanted = s"${plan.width}×${plan.height}"
      throw SceneError(Problem.general(s"reference `$name` must be $wanted pixels, found $found"))
