package candela.measure

import candela.base.{GivenUp, loop}
import candela.image.Image

/** Estimates the error of an image from its own samples: after 2, 4, 8, … samples per pixel from
  * the scatter between halves of the samples and its [[ScatterTrend]], in between by that trend.
  *
  * A rare bright path adds its own square to the scatter, which is its error, whichever half it is
  * in. Its pixel would seem to have no large relative error, as it is bright itself: relative
  * errors divide by [[QuietMeans]]. What no path has found is unknown.
  */
final class ErrorEstimate:
  import ErrorEstimate.{Known, State}
  private var base, middle = Option.empty[State]
  private var whole, halves = Option.empty[Array[Float]] // scatter D(n) and D(n/2) of the last
  private var last = Option.empty[Known]

  /** The squared error of each value of the image after so many samples per pixel; none before the
    * first estimate.
    */
  def squares(samples: Double): Option[Array[Float]] =
    for
      known <- last
      scatter <- whole
    yield
      val factor = known.trend.factor * known.since(samples)
      scatter.map(s => (s * factor).toFloat)

  /** Adds the state of the image after so many samples per pixel, more than before. Uses those
    * after 2ᵏ and 3 · 2ᵏ, and of a continued rendering the first.
    *
    * @param weights of each pixel's samples
    * @param isStopped whether to give up
    * @return the error, if it was estimated anew
    */
  def add(
      samples: Int,
      image: Image,
      weights: Array[Float],
      isLast: Boolean,
      isStopped: () => Boolean = GivenUp.Never
  ): Option[Errors] =
    val state = State(samples, image, weights)
    base match
      case None =>
        base = Some(state)
        None
      case Some(half) if Integer.bitCount(samples) == 1 || (isLast && last.isEmpty) =>
        val known = estimate(half, state, isStopped)
        last = Some(known)
        base = Some(state)
        middle = None
        Some(known.errors)
      case Some(half) =>
        if 2 * samples == 3 * half.samples then middle = Some(state)
        None

  /** The error after so many samples per pixel; none before the first estimate. */
  def at(samples: Double): Option[Errors] = last.map: known =>
    val factor = known.since(samples)
    val errors = known.errors
    errors.copy(mse = errors.mse * factor, relativeMse = errors.relativeMse * factor)

  /** The relative MSE after so many samples per pixel, with its 95 % interval. This has no upper
    * limit where the error is that of few pixels.
    *
    * Its logarithm is uncertain by what few pixels tell, and by how far the trend of scatter can be
    * extrapolated. How far, is calibrated over many scenes by docs/NOISE.md, "Intervals": of one
    * scene the estimate may be too low or too high in all renderings.
    */
  def interval(samples: Double): Option[Interval] =
    for
      known <- last
      errors <- at(samples)
    yield
      val estimate = errors.relativeMse
      def far(ofTrend: Double) =
        val variance = ofTrend * ofTrend + ErrorEstimate.OfPixel / known.pixels
        Math.exp(1.959964 * Math.sqrt(variance))
      val high =
        if isOfFew then Double.PositiveInfinity else estimate * far(ErrorEstimate.TrendUp)
      Interval(estimate, estimate / far(ErrorEstimate.TrendDown), high)

  /** Samples per pixel at which the relative MSE is this. */
  def samplesUntil(relativeMse: Double): Option[Double] = last.map: known =>
    known.samples * known.trend.times(Math.max(relativeMse, 1e-30) / known.errors.relativeMse)

  /** Whether so few pixels have nearly all of the error that it is known to 15 % in fewer than nine
    * of ten cases.
    */
  def isOfFew: Boolean = last.exists(_.pixels < ErrorEstimate.FewPixels)

  private def estimate(half: State, now: State, isStopped: () => Boolean): Known =
    val doubled = now.samples == 2 * half.samples
    val all = ErrorEstimate.scatter(None, half, now, isStopped)
    val second = middle.map(ErrorEstimate.scatter(Some(half), _, now, isStopped))
    val inner = whole.filter(_ => doubled).map: first =>
      second.fold(first)(ErrorEstimate.mean(first, _))
    val variance = inner.fold(all)(ErrorEstimate.pooled(all, _))
    val means = QuietMeans(now.image, variance, isStopped)
    val scatters = Vector(Some(all), inner, halves.filter(_ => doubled))
    val trend =
      if scatters.forall(_.isDefined) then
        def inParts(scatter: Array[Float]) =
          ErrorEstimate.inParts(scatter, now.image, means, isStopped)
        ScatterTrend.of(scatters.flatten.map(inParts))
      else ScatterTrend.Independent
    var squares, relatives, spread = 0.0
    loop(all.length): i =>
      GivenUp.check(isStopped, i)
      val relative = all(i).toDouble * means.weight(i)
      squares += all(i)
      relatives += relative
      spread += relative * relative
    val scale = trend.factor / all.length
    val errors = Errors(squares * scale, relatives * scale, None, None, None, Vector.empty)
    whole = Some(all)
    halves = inner
    val values = if spread > 0 then relatives * relatives / spread else all.length.toDouble
    Known(now.samples, errors, trend, values / now.image.channels)

object ErrorEstimate:
  private final case class State(samples: Int, image: Image, weights: Array[Float])

  /** What is known after so many samples.
    *
    * @param pixels that have the error, about: if all had as much, as many as there are over 3
    */
  private final case class Known(
      samples: Int,
      errors: Errors,
      trend: ScatterTrend,
      pixels: Double
  ):
    /** The relative MSE after other samples, relative to that now. */
    def since(others: Double): Double =
      Math.pow(others / samples, Math.log(trend.ratio) / Math.log(2))

  /** The squared difference of two halves of a pixel has the relative variance 2, and a mean square
    * of 3: the root of a sum is then uncertain by the root of 1 / 6 over these pixels, here 0.075.
    */
  private val FewPixels = 30.0

  /** Standard deviations of the logarithm of an estimate, by its trend: points that get even later
    * than the scatter shows make it too high more often than too low.
    */
  private val TrendUp = 0.12
  private val TrendDown = 0.35

  /** Its variance by the squares of a single pixel, of its true error and of its scatter. */
  private val OfPixel = 4.0 / 3

  /** Of each value the squared difference of the samples from `begin` until `middle`, and until
    * `end`: times the product of their shares of the weight.
    */
  private def scatter(
      begin: Option[State],
      middle: State,
      end: State,
      isStopped: () => Boolean
  ): Array[Float] =
    val values = new Array[Float](end.image.data.length)
    val channels = end.image.channels
    loop(end.weights.length): pixel =>
      GivenUp.check(isStopped, pixel)
      val w0 = begin.fold(0f)(_.weights(pixel)).toDouble
      val w1 = middle.weights(pixel).toDouble
      val w2 = end.weights(pixel).toDouble
      if w1 != w0 && w2 != w1 && w2 != w0 then
        val share = (w1 - w0) * (w2 - w1) / ((w2 - w0) * (w2 - w0))
        loop(channels): c =>
          val i = pixel * channels + c
          val s0 = begin.fold(0.0)(_.image.data(i) * w0)
          val s1 = middle.image.data(i) * w1
          val difference = (s1 - s0) / (w1 - w0) - (end.image.data(i) * w2 - s1) / (w2 - w1)
          values(i) = (difference * difference * Math.max(share, 0)).toFloat
    values

  private def mean(a: Array[Float], b: Array[Float]): Array[Float] =
    Array.tabulate(a.length)(i => (a(i) + b(i)) / 2)

  /** The variance of the mean of all samples, were they independent, from four quarters. */
  private def pooled(all: Array[Float], halves: Array[Float]): Array[Float] =
    Array.tabulate(all.length)(i => (all(i) + halves(i)) / 3)

  /** Relative scatter, added up over squares of 8 × 8 pixels. */
  private def inParts(
      scatter: Array[Float],
      image: Image,
      means: QuietMeans,
      isStopped: () => Boolean
  ): Array[Double] =
    val columns = (image.width + Part - 1) / Part
    val sums = new Array[Double](columns * ((image.height + Part - 1) / Part))
    loop(image.height): y =>
      GivenUp.check(isStopped)
      loop(image.width): x =>
        val part = y / Part * columns + x / Part
        loop(image.channels): c =>
          val i = (y * image.width + x) * image.channels + c
          sums(part) += scatter(i) * means.weight(i)
    sums

  private val Part = 8
