package candela.build

/** What a Film statement says.
  *
  * @param crop         x0, x1, y0, y1 as parts of the full image, or pixels if `inPixels`
  * @param scale        factor of all pixel values
  * @param maxComponent to which brighter samples are scaled down, before `scale`
  */
final case class FilmSettings(
    width: Int,
    height: Int,
    crop: Array[Float],
    inPixels: Boolean,
    filename: String,
    scale: Float,
    maxComponent: Float
)
