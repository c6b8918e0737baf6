package candela.film

import candela.base.loop
import candela.image.Image

/** Accumulates camera samples for the pixels x0 ≤ x < x1, y0 ≤ y < y1.
  *
  * Not synchronised: one worker at a time owns a pixel. Accumulators are Double, so that values
  * don't drift with the number of samples.
  *
  * @param splats accumulates light path splats, if any
  * @param shares if defined, accumulates the samples instead, each contributing to several pixels
  */
final class Film(
    val x0: Int,
    val y0: Int,
    val x1: Int,
    val y1: Int,
    val splats: Option[SplatFilm] = None,
    val shares: Option[SampleShares] = None
):
  require(x1 > x0 && y1 > y0, s"film must not be empty, found [$x0, $x1) × [$y0, $y1)")

  val width: Int = x1 - x0
  val height: Int = y1 - y0

  // For each pixel, row by row: weighted red, green, blue, sum of weights.
  private val sums = new Array[Double](
    if shares.isDefined then 0 else Math.multiplyExact(4, Math.multiplyExact(width, height))
  )

  /** Adds a finite sample to its pixel. */
  def add(x: Int, y: Int, r: Float, g: Float, b: Float, weight: Float): Unit =
    val at = 4 * ((y - y0) * width + (x - x0))
    sums(at) += weight.toDouble * r
    sums(at + 1) += weight.toDouble * g
    sums(at + 2) += weight.toDouble * b
    sums(at + 3) += weight.toDouble

  /** A copy of the current state, for [[since]]. */
  def copy(): Film =
    val film = Film(x0, y0, x1, y1, splats.map(_.copy()), shares.map(_.copy()))
    System.arraycopy(sums, 0, film.sums, 0, sums.length)
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
    System.arraycopy(sums, 0, added.sums, 0, sums.length)
    loop(sums.length)(i => added.sums(i) -= earlier.sums(i))
    added

  /** The weighted averages, times `scale`; pixels without samples are black. May be called while
    * others add; the image then holds the current state.
    */
  def toImage(scale: Float): Image =
    val image = Image.rgb(width, height)
    val all = shares.fold(sums)(_.sums)
    loop(width * height): pixel =>
      val weight = all(4 * pixel + 3)
      if weight != 0 then
        loop(3): c =>
          image.data(3 * pixel + c) = (all(4 * pixel + c) / weight * scale).toFloat
    splats.foreach(_.addTo(image.data, scale))
    image
