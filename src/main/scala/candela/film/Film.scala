package candela.film

import candela.base.{CheckedInput, CheckedOutput, loop}
import candela.image.Image

import java.util.Arrays

/** Accumulates camera samples for the pixels x0 ≤ x < x1, y0 ≤ y < y1.
  *
  * Not synchronised: one worker at a time owns a pixel. Sums are exact: a film may be divided and
  * added in any order.
  *
  * @param splats accumulates light path splats, if any
  * @param shares if defined, accumulates the samples instead, each contributing to several pixels
  * @param bands  also accumulates light by wavelength, if wanted; [[copy]] and [[since]] do not
  */
final class Film(
    val x0: Int,
    val y0: Int,
    val x1: Int,
    val y1: Int,
    val splats: Option[SplatFilm] = None,
    val shares: Option[SampleShares] = None,
    val bands: Option[BandFilm] = None
):
  require(x1 > x0 && y1 > y0, s"film must not be empty, found [$x0, $x1) × [$y0, $y1)")

  val width: Int = x1 - x0
  val height: Int = y1 - y0

  // For each pixel, row by row: weighted red, green, blue, sum of weights.
  private val sums = ExactSums(
    if shares.isDefined then 0 else Math.multiplyExact(4, Math.multiplyExact(width, height))
  )

  /** Adds a finite sample to its pixel. */
  def add(x: Int, y: Int, r: Float, g: Float, b: Float, weight: Float): Unit =
    val at = 4 * ((y - y0) * width + (x - x0))
    // The products of two Floats are exact, too
    sums.add(at, weight.toDouble * r)
    sums.add(at + 1, weight.toDouble * g)
    sums.add(at + 2, weight.toDouble * b)
    sums.add(at + 3, weight.toDouble)

  /** A copy of the current state, for [[since]]. */
  def copy(): Film =
    val film = Film(x0, y0, x1, y1, splats.map(_.copy()), shares.map(_.copy()))
    film.sums.add(sums)
    film

  /** The delta: samples added since `earlier` was copied. */
  def since(earlier: Film): Film =
    val added = Film(
      x0,
      y0,
      x1,
      y1,
      splats.zip(earlier.splats).map(_.since(_)),
      shares.zip(earlier.shares).map(_.since(_))
    )
    added.sums.add(sums)
    added.sums.add(earlier.sums, isNegative = true)
    added

  /** Writes the state, in a form that depends only on the samples. */
  def save(to: CheckedOutput): Unit =
    shares.fold(sums.save(to))(_.save(to))
    splats.foreach(_.save(to))
    bands.foreach(_.save(to))

  /** Adds what was saved by a film of the same size and kind. */
  def load(from: CheckedInput): Unit =
    shares.fold(sums.load(from))(_.load(from))
    splats.foreach(_.load(from))
    bands.foreach(_.load(from))

  /** For each pixel, row by row, the sum of its samples' weights. Without camera samples: the
    * number of light paths, in all pixels.
    */
  def weights: Array[Float] =
    val shared = shares.map(_.sums)
    val weights = new Array[Float](width * height)
    loop(weights.length): pixel =>
      val at = 4 * pixel + 3
      weights(pixel) = shared.fold(sums(at))(_(at)).toFloat
    if weights.forall(_ == 0) then
      for s <- splats do Arrays.fill(weights, s.pathCount.toFloat)
    weights

  /** The weighted averages, times `scale`; pixels without samples are black. May be called while
    * others add; the image then holds the current state.
    */
  def toImage(scale: Float): Image =
    val image = Image.rgb(width, height)
    val shared = shares.map(_.sums)
    def all(i: Int) = shared.fold(sums(i))(_(i))
    loop(width * height): pixel =>
      val weight = all(4 * pixel + 3)
      if weight != 0 then
        loop(3): c =>
          image.data(3 * pixel + c) = (all(4 * pixel + c) / weight * scale).toFloat
    splats.foreach(_.addTo(image.data, scale))
    image
