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
  import ErrorEstimate.{Known, Scatter, State, Weighed}
  private var base, middle = Option.empty[State]
  private var latest, earlier = Option.empty[Weighed] // the last state, and the base before
  private var whole, halves = Option.empty[Scatter] // D(n) and D(n/2) of the last
  private var last = Option.empty[Known]
  private var before = Vector.empty[Known] // the latest first

  /** The squared error of each value of the image after so many samples per pixel; none before the
    * first estimate.
    */
  def squares(samples: Double): Option[Array[Float]] =
    for
      known <- last
      scatter <- whole
    yield
      val factor = known.trend.factor * known.since(samples)
      scatter.values.map(s => (s * factor).toFloat)

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
    // Nothing changes if the estimate is given up
    val found = base match
      case None =>
        base = Some(state)
        None
      case Some(half) if Integer.bitCount(samples) == 1 || (isLast && last.isEmpty) =>
        val known = estimate(half, state, isStopped)
        before = last.filter(_.samples >= ErrorEstimate.FewToForetell).toVector ++ before
        last = Some(known)
        earlier = Some(half.weighed)
        base = Some(state)
        middle = None
        Some(known.errors)
      case Some(half) =>
        if 2 * samples == 3 * half.samples then middle = Some(state)
        None
    latest = Some(state.weighed)
    found

  /** The error after so many samples per pixel; none before the first estimate. */
  def at(samples: Double): Option[Errors] = last.map: known =>
    val factor = known.since(samples)
    val errors = known.errors
    errors.copy(mse = errors.mse * factor, relativeMse = errors.relativeMse * factor)

  /** The relative MSE after so many samples per pixel, with its 95 % interval. This has no upper
    * limit where the error is that of few pixels, and its lower one is what the error would be if
    * their own means were true: a speck at the edge of an emitter may be part of it.
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
        ErrorEstimate.factor(Math.sqrt(variance))
      val low = estimate / far(ErrorEstimate.TrendDown)
      if isOfFew then
        val sure = estimate * known.sure / ErrorEstimate.factor(ErrorEstimate.TrendDown)
        Interval(estimate, Math.min(low, sure), Double.PositiveInfinity)
      else Interval(estimate, low, estimate * far(ErrorEstimate.TrendUp))

  /** Samples per pixel with which the relative MSE is at most this. Up to the next power of two,
    * where the error is estimated anew, that is what [[at]] says, to an eighth of a power of two or
    * a smaller part. Beyond, it is the geometric mean of what this and the earlier estimates say,
    * the earlier the less, as noise changes from one power of two to the next; each says it to an
    * eighth. The 95 % interval is that of the number with which it will say so. There is none after
    * two samples only, and where few pixels have the error it tells nothing: the next estimate may
    * be a thousandth.
    */
  def samplesUntil(relativeMse: Double): Option[Interval] =
    for
      known <- last if !known.errors.relativeMse.isNaN
      now <- latest
    yield
      val times = known.times(relativeMse)
      val isSoon = times < 2
      val samples =
        if isSoon then known.samples * times
        else
          val minSamples = 2.0 * known.samples
          var sum, weights = 0.0
          for (k, i) <- (known +: before).zipWithIndex do
            val weight = Math.scalb(1.0, -i)
            val byWeight = (k.times(relativeMse) * k.weight - now.weight) / sampleWeight
            sum += weight * Math.log(Math.max(minSamples, now.samples + byWeight))
            weights += weight
          Math.max(minSamples, Math.exp(sum / weights))
      val ahead = Math.log(Math.max(1, samples / now.samples)) / Math.log(2)
      val far = ErrorEstimate.factor(ErrorEstimate.deviation(now.samples, isSoon, ahead))
      if now.samples < ErrorEstimate.FewSamples then Interval(samples, Double.NaN, Double.NaN)
      else
        val soonest = Math.min(samples, now.samples)
        if isOfFew then Interval(samples, soonest, Double.PositiveInfinity)
        else Interval(samples, Math.max(soonest, samples / far), samples * far)

  /** Of one of the latest samples. Those of guided passes may count more than those before. */
  private def sampleWeight: Double =
    val perSample =
      for
        now <- latest
        from <- (base.map(_.weighed) ++ earlier).find(_.samples < now.samples)
      yield (now.weight - from.weight) / (now.samples - from.samples)
    perSample.filter(_ > 0).orElse(latest.map(now => now.weight / now.samples)).getOrElse(1.0)

  /** Whether so few pixels have nearly all of the error that it is known to 15 % in fewer than nine
    * of ten cases.
    */
  def isOfFew: Boolean = last.exists(_.pixels < ErrorEstimate.FewPixels)

  private def estimate(half: State, now: State, isStopped: () => Boolean): Known =
    val doubled = now.samples == 2 * half.samples
    val full = ErrorEstimate.scatter(None, half, now, isStopped)
    val second = middle.map(ErrorEstimate.scatter(Some(half), _, now, isStopped))
    val inner = whole.filter(_ => doubled).map: first =>
      second.fold(first)(ErrorEstimate.mean(first, _))
    val variance = inner.fold(full.values)(ErrorEstimate.pooled(full, _))
    val means = QuietMeans(now.image, variance, isStopped)
    val scatters = Vector(Some(full), inner, halves.filter(_ => doubled))
    val trend =
      if scatters.forall(_.isDefined) then
        // As if all samples had the same weight
        val squareSums =
          for (scatter, i) <- scatters.flatten.zipWithIndex yield
            val scale = Math.scalb(full.unit, i) / scatter.unit
            ErrorEstimate.inParts(scatter.values, now.image, means, isStopped).map(_ * scale)
        ScatterTrend.of(squareSums, now.samples)
      else ScatterTrend.Independent
    var squares, relatives, spread, sure = 0.0
    loop(full.values.length): i =>
      GivenUp.check(isStopped, i)
      val relative = full.values(i).toDouble * means.weight(i)
      squares += full.values(i)
      relatives += relative
      sure += full.values(i) * Math.min(means.weight(i), means.ownWeight(i))
      spread += relative * relative
    val scale = trend.factor / full.values.length
    val errors = Errors(squares * scale, relatives * scale, None, None, None, Vector.empty)
    whole = Some(full)
    halves = inner
    val values = if spread > 0 then relatives * relatives / spread else full.values.length.toDouble
    val sureShare = if relatives > 0 then sure / relatives else 1.0
    Known(now.samples, now.weighed.weight, errors, trend, values / now.image.channels, sureShare)

object ErrorEstimate:
  /** Samples between two numbers at which a rendering may end by its error. */
  private val MostApart = 64

  private final case class State(samples: Int, image: Image, weights: Array[Float]):
    val weighed: Weighed =
      var sum = 0.0
      loop(weights.length)(i => sum += weights(i))
      Weighed(samples, sum / Math.max(1, weights.length))

  /** Samples per pixel, and their weight, on average over the pixels. */
  private final case class Weighed(samples: Int, weight: Double)

  /** Fewer samples say nothing about how many more it takes. */
  private val FewSamples = 3

  /** Estimates after fewer samples don't count beside later ones: noise still changes its trend. */
  private val FewToForetell = 8

  /** How far a value may be from its estimate, with 95 %, whose logarithm has such a deviation. */
  private def factor(deviation: Double): Double = Math.exp(1.959964 * deviation)

  /** Standard deviation of the logarithm of the samples at which an error is seen to be reached, by
    * docs/NOISE.md, "Time left".
    *
    * @param isSoon whether that is expected before the next power of two
    * @param ahead  doublings of the samples until then
    */
  private def deviation(samples: Int, isSoon: Boolean, ahead: Double): Double =
    if isSoon then 0.08
    else 0.11 * Math.hypot(1, 20.0 / samples) * Math.sqrt((1 + Math.max(1, ahead)) / 2)

  /** Scatter between two parts of the samples.
    *
    * @param values of each value of the image
    * @param unit   what it is expected to be for independent samples with the variance 1 / weight
    */
  private final case class Scatter(values: Array[Float], unit: Double)

  /** What is known after some samples.
    *
    * @param weight of a pixel's samples
    * @param pixels that have the error, about: if all had as much, as many as there are over 3
    * @param sure   part of the relative error that there is if each pixel's own mean is true
    */
  private final case class Known(
      samples: Int,
      weight: Double,
      errors: Errors,
      trend: ScatterTrend,
      pixels: Double,
      sure: Double
  ):
    /** The relative MSE after other samples, relative to that now. Those that count more are not
      * more evenly spread before they are twice as many.
      */
    def since(others: Double): Double = trend.after(others / samples)

    /** How many times these samples have at most this relative MSE ([[ScatterTrend.times]]). */
    def times(relativeMse: Double): Double =
      val ratio = relativeMse / Math.max(errors.relativeMse, 1e-30)
      trend.times(ratio, MostApart / samples.toDouble)

  /** The squared difference of two halves of a pixel has the relative variance 2, and a mean square
    * of 3: the root of a sum is then uncertain by the root of 1 / 6 over these pixels, here 0.075.
    */
  private val FewPixels = 30.0

  /** Standard deviations of the logarithm of an estimate, by its trend: points that get even later
    * than the scatter shows make it too high more often than too low.
    */
  private val TrendUp = 0.12
  private val TrendDown = 0.36

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
  ): Scatter =
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
    val weight = end.weighed.weight - begin.fold(0.0)(_.weighed.weight)
    Scatter(values, 1 / Math.max(weight, 1e-30))

  private def mean(a: Scatter, b: Scatter): Scatter =
    val values = Array.tabulate(a.values.length)(i => (a.values(i) + b.values(i)) / 2)
    Scatter(values, (a.unit + b.unit) / 2)

  /** The variance of the mean of all samples, were they independent, from four quarters. */
  private def pooled(all: Scatter, halves: Scatter): Array[Float] =
    val scale = (2 * all.unit / halves.unit).toFloat
    Array.tabulate(all.values.length)(i => (all.values(i) + scale * halves.values(i)) / 3)

  /** Relative scatter, added up over squares of 8 × 8 pixels. */
  private def inParts(
      scatter: Array[Float],
      image: Image,
      means: QuietMeans,
      isStopped: () => Boolean
  ): Array[Double] =
    val columns = (image.width + SquareSide - 1) / SquareSide
    val sums = new Array[Double](columns * ((image.height + SquareSide - 1) / SquareSide))
    loop(image.height): y =>
      GivenUp.check(isStopped)
      loop(image.width): x =>
        val square = y / SquareSide * columns + x / SquareSide
        loop(image.channels): c =>
          val i = (y * image.width + x) * image.channels + c
          sums(square) += scatter(i) * means.weight(i)
    sums

  /** In pixels. */
  private val SquareSide = 8
