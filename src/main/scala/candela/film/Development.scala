package candela.film

import candela.base.loop
import candela.color.ColorResponse
import candela.image.Image

/** What becomes of the means of a pixel's samples.
  *
  * @param scale         factor of all values
  * @param sensor        what a camera's three kinds of cells make of red, green and blue; if empty
  *                      they are those of the standard observer
  * @param balance       nine numbers, row by row, that map what the cells make to what is written;
  *                      if empty it stays as it is
  * @param clipsNegative filters with negative lobes leave values below 0: pbrt-v2 and v3 write 0
  *                      for them
  * @param isHalf        are 16 bits of each value written, not 32?
  * @param bands         of wavelengths that are written behind the colours, if any
  */
final case class Development(
    scale: Float = 1f,
    sensor: Option[ColorResponse] = None,
    balance: Option[Array[Float]] = None,
    clipsNegative: Boolean = false,
    isHalf: Boolean = false,
    bands: Option[SpectralBands] = None
):

  def apply(film: Film): Image =
    val image = film.toImage(scale)
    for response <- sensor; pixel <- 0 until image.width * image.height do
      val at = 3 * pixel
      response(image.data(at), image.data(at + 1), image.data(at + 2), image.data, at)
    for m <- balance do
      loop(image.width * image.height): pixel =>
        val at = 3 * pixel
        val r = image.data(at)
        val g = image.data(at + 1)
        val b = image.data(at + 2)
        loop(3)(c => image.data(at + c) = m(3 * c) * r + m(3 * c + 1) * g + m(3 * c + 2) * b)
    if clipsNegative then loop(image.data.length)(i => image.data(i) = Math.max(0f, image.data(i)))
    image
