package candela.film

import candela.cameras.{Camera, Shutter}

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
