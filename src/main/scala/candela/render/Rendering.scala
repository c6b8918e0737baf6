package candela.render

import candela.film.{Development, Film, LayerFilm}
import candela.image.Image

/** Camera samples that were no light (NaN or infinite), and so were left out of the image.
  *
  * @param x the pixel of the first one, with `y`: first by sample number, then by row
  * @param material the number of the material that its path met last, −1: unknown
  */
final case class Refused(count: Long, x: Int, y: Int, sample: Int, material: Int = -1)

/** What came out of a rendering.
  *
  * @param samplesPerPixel that were planned
  * @param samplesDone     that every pixel has at least; less than planned if it was cancelled
  * @param samplesTaken    camera samples in all pixels together
  * @param rays            traced, of all kinds
  * @param refused         none if there were none
  * @param layers          if the image has more than colours
  */
final case class Rendering(
    film: Film,
    samplesPerPixel: Int,
    samplesDone: Int,
    samplesTaken: Long,
    rays: Long,
    seconds: Double,
    refused: Option[Refused],
    layers: Option[LayerFilm] = None
):
  /** Colours, then the layers, then the bands of wavelengths. */
  def image(development: Development): Image =
    val colors = development(film)
    val layered = layers.fold(colors)(_.behind(colors, development.scale))
    development.bands.fold(layered)(_.behind(layered, film.toImage(1f)))

  def isComplete: Boolean = samplesDone == samplesPerPixel

/** A bug that showed itself in one sample: `cause` says what, the rest where. */
final class RenderFailure(val x: Int, val y: Int, val sample: Int, cause: Throwable)
    extends RuntimeException(s"at pixel ($x, $y), sample $sample: $cause", cause)
