package candela.film

import candela.base.loop
import candela.concurrency.{GivenUp, Parallel}
import candela.io.{CheckedInput, CheckedOutput}
import candela.image.Image

import java.util.Arrays

/** Accumulates camera samples for the pixels of `bounds`.
  *
  * Not synchronised: one worker at a time owns a pixel. Sums are exact: a film may be divided and
  * added in any order.
  *
  * @param splats accumulates light path splats, if any
  * @param shares if defined, accumulates the samples instead, each contributing to several pixels
  * @param bands  also accumulates light by wavelength, if wanted; not for [[copy]], [[deltaSince]]
  * @param levels also accumulates light by brightness, to leave out fireflies; likewise
  * @param volume what a sample adds to the weights of all pixels
  */
final class Film(
    val bounds: PixelBounds,
    val splats: Option[SplatFilm] = None,
    val shares: Option[SampleShares] = None,
    val bands: Option[BandFilm] = None,
    val levels: Option[BrightnessLevels] = None,
    volume: Double = 1
):
  require(bounds.width > 0 && bounds.height > 0, s"film must not be empty, found $bounds")

  private val x0 = bounds.x0
  private val y0 = bounds.y0
  val width: Int = bounds.width
  val height: Int = bounds.height

  // For each pixel, row by row: weighted red, green, blue, sum of weights.
  private val sums = ExactSums(
    if shares.isDefined then 0 else Math.multiplyExact(4, Math.multiplyExact(width, height))
  )

  /** Adds a finite sample to its pixel. */
  def add(x: Int, y: Int, r: Float, g: Float, b: Float, weight: Float): Unit =
    val offset = 4 * ((y - y0) * width + (x - x0))
    // The products of two Floats are exact, too
    sums.add(offset, weight.toDouble * r)
    sums.add(offset + 1, weight.toDouble * g)
    sums.add(offset + 2, weight.toDouble * b)
    sums.add(offset + 3, weight.toDouble)

  /** A copy of the current state, for [[deltaSince]]. */
  def copy(): Film =
    val film = Film(bounds, splats.map(_.copy()), shares.map(_.copy()))
    film.sums.add(sums)
    film

  /** The delta: samples added since `earlier` was copied. */
  def deltaSince(earlier: Film): Film =
    val added = Film(
      bounds,
      splats.zip(earlier.splats).map(_.deltaSince(_)),
      shares.zip(earlier.shares).map(_.deltaSince(_))
    )
    added.sums.add(sums)
    added.sums.add(earlier.sums, isNegative = true)
    added

  /** Writes the state, in a form that depends only on the samples. */
  def save(to: CheckedOutput): Unit =
    shares.fold(sums.save(to))(_.save(to))
    splats.foreach(_.save(to))
    bands.foreach(_.save(to))
    levels.foreach(_.save(to))

  /** Adds what was saved by a film of the same size and kind. */
  def load(from: CheckedInput): Unit =
    shares.fold(sums.load(from))(_.load(from))
    splats.foreach(_.load(from))
    bands.foreach(_.load(from))
    levels.foreach(_.load(from))

  /** The weighted averages, times `scale`; pixels without samples are black. May be called while
    * others add; the image then holds the current state.
    *
    * @param weights set to the sum of the weights of each pixel's samples, row by row, at the same
    *                moment; without camera samples to the number of light paths, in all pixels
    * @param isWhole whether fireflies remain, too
    * @param isStopped whether to give up
    * @param pool      divides the rows
    */
  def toImage(
      scale: Float,
      weights: Option[Array[Float]] = None,
      isWhole: Boolean = false,
      isStopped: () => Boolean = GivenUp.Never,
      pool: Parallel = Parallel.Alone
  ): Image =
    val image = Image.rgb(width, height)
    val cleaned = if isWhole then None else levels.map(withoutFireflies)
    val data = image.data
    val weightOf = weights.orNull
    pool.forEach((height + Film.Rows - 1) / Film.Rows): part =>
      val row = new Array[Double](4 * width)
      for y <- part * Film.Rows until Math.min(height, (part + 1) * Film.Rows) do
        GivenUp.check(isStopped)
        cleaned.fold(read(y, row))(System.arraycopy(_, 4 * width * y, row, 0, 4 * width))
        var x = 0
        while x < width do
          val pixel = y * width + x
          val weight = row(4 * x + 3)
          if weightOf != null then weightOf(pixel) = weight.toFloat
          if weight != 0 then
            data(3 * pixel) = (row(4 * x) / weight * scale).toFloat
            data(3 * pixel + 1) = (row(4 * x + 1) / weight * scale).toFloat
            data(3 * pixel + 2) = (row(4 * x + 2) / weight * scale).toFloat
          x += 1
    for s <- splats do
      s.addTo(image.data, scale)
      for w <- weights if w.forall(_ == 0) do Arrays.fill(w, s.sampleCount.toFloat)
    image

  /** The share of the light that [[toImage]] leaves out with fireflies. */
  def leftOut: Double =
    def sum(image: Image) = image.data.map(_.toDouble).sum
    val total = sum(toImage(1f, isWhole = true))
    if levels.isEmpty || total == 0 then 0 else 1 - sum(toImage(1f)) / total

  private def withoutFireflies(levels: BrightnessLevels): Array[Double] =
    val result = new Array[Double](4 * width * height)
    val row = new Array[Double](4 * width)
    loop(height): y =>
      read(y, row)
      System.arraycopy(row, 0, result, 4 * width * y, 4 * width)
    FireflyWeights(levels, bounds, volume)(result)
    result

  private def read(y: Int, row: Array[Double]): Unit =
    shares match
      case Some(s) => s.read(y0 + y, row)
      case None =>
        Arrays.fill(row, 0.0)
        sums.addTo(row, 0, 4 * y * width, 4 * width)

object Film:
  /** Rows that a thread develops at a time. */
  private val Rows = 16
