package candela.job

import candela.concurrency.GivenUp
import candela.film.{Development, Film}
import candela.image.Image
import candela.measure.{CurvePoint, ErrorEstimate, Errors, HalfScatter, Interval}
import candela.render.{Looks, Pass, Rendering, RenderListener}

/** Measures the error of the image after 1, 2, 4, 8, … samples per pixel, or estimates it after 2,
  * 4, 8, …; and at the end.
  *
  * @param reference same size as the image; None: errors are estimated from the noise
  * @param estimates when errors are estimated
  */
class ErrorRecorder(
    development: Development,
    reference: Option[Image],
    estimates: Looks = Looks.Waves
) extends RenderListener:
  private val curve = Vector.newBuilder[CurvePoint]
  private val scatter = HalfScatter()
  private var spent = 0.0

  // Samples per pixel from which all pixels have equally many: fewer are no half of those of each
  private var firstEven = 0

  def points: Vector[CurvePoint] = curve.result()

  /** The latest; None before the first, and with a reference. */
  def estimate: Option[ErrorEstimate] = scatter.estimate

  /** Time spent on measuring, in seconds. */
  def seconds: Double = spent

  /** The estimated error of each value of the image after so many samples per pixel: squared, in
    * the order of its data.
    */
  def squares(samples: Double): Option[Array[Float]] = scatter.squares(samples)

  override def frequency: Looks = if reference.isEmpty then estimates else Looks.Doublings

  override def begins(samples: Int, maxSamples: Int, film: Film): Unit =
    firstEven = maxSamples
    if reference.isEmpty && samples > 0 && samples == maxSamples then
      val weights = new Array[Float](film.width * film.height)
      val _ = scatter.add(samples, development(film, Some(weights)), weights, isLast = false)

  /** The relative error after so many samples per pixel, as far as known: the root of the relative
    * MSE.
    */
  override def errorAt(samples: Double): Option[Double] =
    val errors =
      if reference.isEmpty then estimate.map(_.at(samples)) else points.lastOption.map(_.errors)
    errors.map(e => Math.sqrt(e.relativeMse)).filter(_.isFinite)

  /** The estimated relative MSE, as `errorAt` has it, with its interval. */
  def relativeMse(samples: Double): Option[Interval] =
    for
      error <- errorAt(samples)
      limits <- interval(samples)
    yield limits.copy(estimate = error * error)

  /** The estimated relative MSE after so many samples per pixel, with its 95 % interval. */
  def interval(samples: Double): Option[Interval] =
    estimate.map(_.interval(samples))

  /** Samples per pixel with which the relative error is at most this, with the 95 % interval: any
    * number where it is estimated, doublings where it is measured.
    */
  def samplesUntil(error: Double): Option[Interval] =
    val relativeMse = error * error
    if reference.isEmpty then
      estimate.filterNot(_.relative.isNaN).map(_.samplesUntil(relativeMse))
    else
      // Of an image without a number in common with the reference, no error is known
      points.lastOption.filterNot(_.errors.relativeMse.isNaN).map: p =>
        val doublings = Math.log(p.errors.relativeMse / relativeMse) / Math.log(2)
        if doublings <= 0 then Interval(p.samples, p.samples, p.samples)
        else
          val end = p.samples * Math.pow(2, Math.ceil(doublings))
          Interval(end, Math.max(p.samples, end / 2), end * 2)

  override def passed(pass: Pass, film: Film): Unit =
    val started = System.nanoTime
    try measure(pass, film)
    catch case _: GivenUp => () // the rendering ends without
    spent += (System.nanoTime - started) * 1e-9

  /** Adds the error of the final image, if the rendering ended between two measurements. */
  def ended(rendering: Rendering): Unit =
    val samples = rendering.samplesDone
    if samples > 0 && points.lastOption.forall(_.samples < samples) then
      val errors = reference match
        case Some(r) => Some(Errors.against(r)(development(rendering.film)))
        case None => estimate.map(_.at(samples))
      for e <- errors do
        curve += CurvePoint(samples, rendering.seconds, e, interval(samples))

  /** Called after each pass, with its image, which is developed when it is asked for. */
  protected def measured(pass: Pass, image: => Image): Unit = ()

  private def measure(pass: Pass, film: Film): Unit =
    lazy val weights = new Array[Float](film.width * film.height)
    lazy val image = development(film, Some(weights), pass.isStopped)
    val errors = reference match
      case Some(r) => Option.when(pass.isMain)(Errors.against(r)(image))
      case None =>
        val latest =
          if pass.samples < firstEven || !scatter.uses(pass.samples, pass.isLast) then None
          else scatter.add(pass.samples, image, weights, pass.isLast, pass.isStopped)
        latest.orElse(estimate.filter(_ => pass.isLast)).map(_.at(pass.samples))
    val interval = this.interval(pass.samples)
    errors.foreach(e => curve += CurvePoint(pass.samples, pass.endSeconds, e, interval))
    measured(pass, image)
