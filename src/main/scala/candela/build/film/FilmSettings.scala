package candela.build.film

import candela.film.{Development, Layer, SampleLimit}

/** What a Film statement says.
  *
  * @param crop         x0, x1, y0, y1 as parts of the full image, or pixels if `inPixels`
  * @param development  how pixel values are made, but for the time that v4's shutter is open
  * @param limit        of samples, for a factor by which v4 multiplies them first
  * @param diagonal     of the film, in metres
  * @param layers       what the image holds beside colours
  * @param layersInWorld are they in world space, not in the camera's?
  */
final case class FilmSettings(
    width: Int,
    height: Int,
    crop: Array[Float],
    inPixels: Boolean,
    filename: String,
    development: Development,
    limit: Float => Option[SampleLimit],
    diagonal: Float,
    layers: Vector[Layer] = Vector.empty,
    layersInWorld: Boolean = false
)
