package candela.cli.rendering

import candela.base.{GivenUp, Problem, SceneError}
import candela.cli.files.OutputFiles
import candela.cli.terminal.Figures
import candela.film.{Development, Film}
import candela.image.{Image, ImageFiles}
import candela.measure.{CurvePoint, ErrorEstimate, Errors, PixelWindow}
import candela.render.{Looks, Pass, RenderListener, RenderPlan}
import candela.report.{PassSpan, Picture}

/** Measures the error of the image after 1, 2, 4, 8, … samples per pixel, and at the end.
  *
  * @param reference same size as the image; None: errors are estimated from the noise
  */
final class RenderRecorder(development: Development, reference: Option[Image])
    extends RenderListener:
  private val foundPoints = Vector.newBuilder[CurvePoint]
  private val foundPasses = Vector.newBuilder[PassSpan]
  private var first, last: Option[(Image, Int)] = None
  private val estimate = ErrorEstimate()
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

  /** The estimate compares parts of the samples. */
  override def looks: Looks = if reference.isEmpty then Looks.Waves else Looks.Doublings

  override def begins(samples: Int, film: Film): Unit =
    if reference.isEmpty && samples > 0 then
      val weights = new Array[Float](film.width * film.height)
      val _ = estimate.add(samples, development(film, Some(weights)), weights, isLast = false)

  /** The relative error after so many samples per pixel, as far as known: the root of the relative
    * MSE.
    */
  override def errorAt(samples: Double): Option[Double] =
    val errors =
      if reference.isEmpty then estimate.at(samples) else points.lastOption.map(_.errors)
    errors.map(e => Math.sqrt(e.relativeMse))

  /** Samples per pixel at which the relative error falls to this, by its trend. */
  def samplesUntil(error: Double): Option[Double] =
    val relativeMse = error * error
    if reference.isEmpty then estimate.samplesUntil(relativeMse)
    else points.lastOption.map(p => p.samples * p.errors.relativeMse / relativeMse)

  override def passed(pass: Pass, film: Film): Unit =
    val started = System.nanoTime
    try measure(pass, film)
    catch case _: GivenUp => () // the rendering ends without
    spent += (System.nanoTime - started) * 1e-9

  private def measure(pass: Pass, film: Film): Unit =
    val weights = new Array[Float](film.width * film.height)
    val image = development(film, Some(weights), pass.isStopped)
    val errors = reference match
      case Some(r) => Option.when(pass.isMain)(Errors.against(r)(image))
      case None =>
        val anew = estimate.add(pass.samples, image, weights, pass.isLast, pass.isStopped)
        anew.orElse(Option.when(pass.isLast)(estimate.at(pass.samples)).flatten)
    errors.foreach(e => foundPoints += CurvePoint(pass.samples, pass.end, e))
    foundPasses += PassSpan(pass.samples, pass.begin, pass.end, pass.workers)
    if first.isEmpty then first = Some((image, pass.samples))
    last = Some((image, pass.samples))

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
