package candela.film

import candela.cameras.{Camera, Shutter}
import candela.color.{Rgb, Wavelengths}

/** Receives splats from light subpaths, anywhere on the film. Thread-safe. */
abstract class Splats:

  /** Counts a sample: splats are averaged over the number of samples. */
  def countSample(): Unit

  /** @param x     in pixels from the left edge of the full image, `y` from its top; may be outside
    * @param group of the light, if its groups are told apart
    */
  def add(x: Float, y: Float, light: Rgb, group: Int): Unit

  /** Adds light of a strategy that is kept beside the image. */
  def addStrategy(x: Float, y: Float, light: Rgb, strategy: Int): Unit = ()

  /** Adds the same splat to bands of wavelengths, if there are any.
    *
    * @param light at the wavelengths of `basis`
    */
  def addToBands(x: Float, y: Float, basis: Wavelengths, light: Rgb): Unit

object Splats:
  /** Discards splats: for tracing a single sample, whose splats would land in other pixels. */
  object Discarded extends Splats:
    def countSample(): Unit = ()
    def add(x: Float, y: Float, light: Rgb, group: Int): Unit = ()
    def addToBands(x: Float, y: Float, basis: Wavelengths, light: Rgb): Unit = ()

/** Camera and film, for rendering methods that choose film positions.
  *
  * @param splats            receives the splats of light paths
  * @param crop              rendered pixels of an image of `width` × `height`
  * @param shutter           shutter interval, if anything is animated
  * @param differentialScale scale of camera ray differentials; 0: the scene needs none
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

  /** Bounds, with the following, all film positions that contribute to a pixel of `crop`. */
  val x0: Float = crop.x0 - (filter.radiusX - 0.5f)
  val y0: Float = crop.y0 - (filter.radiusY - 0.5f)
  val x1: Float = crop.x1 + (filter.radiusX - 0.5f)
  val y1: Float = crop.y1 + (filter.radiusY - 0.5f)
