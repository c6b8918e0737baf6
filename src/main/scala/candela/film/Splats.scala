package candela.film

import candela.cameras.{Camera, Shutter}
import candela.color.Rgb

/** Receives light that paths from the lights bring to any place on the film. Thread-safe. */
abstract class Splats:

  /** A path sets out from the lights: the sum of all splats is divided by the number of paths. */
  def begin(): Unit

  /** @param x in pixels from the left edge of the full image, `y` from its top; perhaps outside */
  def add(x: Float, y: Float, light: Rgb): Unit

object Splats:
  /** For a sample taken by itself, whose splats would belong to other pixels. */
  object Discarded extends Splats:
    def begin(): Unit = ()
    def add(x: Float, y: Float, light: Rgb): Unit = ()

/** The camera and film of one rendering, as methods need them that choose places on the film.
  *
  * @param splats  receives what paths from the lights bring
  * @param crop    the pixels that are rendered, of an image of `width` × `height`
  * @param shutter when it is open, if anything moves
  * @param differentialScale of camera rays' differentials; 0: nothing in the scene asks for them
  */
final case class View(
    camera: Camera,
    splats: Splats,
    width: Int,
    height: Int,
    crop: PixelBounds,
    filter: Filter,
    samplesPerPixel: Int,
    shutter: Option[Shutter],
    differentialScale: Float
):
  /** Of the full image. */
  val pixels: Double = width.toDouble * height

  /** With the others, bounds all places whose light counts in a pixel of `crop`. */
  val x0: Float = crop.x0 - (filter.radiusX - 0.5f)
  val y0: Float = crop.y0 - (filter.radiusY - 0.5f)
  val x1: Float = crop.x1 + (filter.radiusX - 0.5f)
  val y1: Float = crop.y1 + (filter.radiusY - 0.5f)
