package candela.lights

import candela.color.Rgb
import candela.math.*
import candela.textures.MipLevel

/** An environment map whose pixels are read in tiles; the same as one in memory.
  *
  * @param pixels red, green, blue, linear
  * @param stored makes colours of the scene's basis of the pixels, if they are of another
  */
final class TiledSphereImage(
    pixels: MipLevel,
    stored: Option[Rgb => Rgb],
    layout: SphereMap,
    factor: Rgb,
    smooth: Boolean,
    colors: Option[Rgb => Rgb] = None
) extends SphereImage(pixels.width, pixels.height, layout, factor, smooth, colors):
  private val rebase: (Rgb => Rgb) | Null = stored.orNull
  private val isScaled = colors.isEmpty && factor != Rgb.White

  protected def pixel(x: Int, y: Int): Rgb =
    texelColor(pixels.texel(pixels.index(x, y)))

  private def texelColor(c: Rgb): Rgb =
    val change = rebase
    val rebased = if change == null then c else change(c)
    if isScaled then Rgb(rebased.r * factor.r, rebased.g * factor.g, rebased.b * factor.b)
    else rebased

  protected def blended(x: Float, y: Float): Rgb =
    val i = Math.floor(x).toInt
    val j = Math.floor(y).toInt
    val (tx, ty) = (x - i, y - j)
    val a = wrapped(i, j)
    val b = wrapped(i + 1, j)
    val c = wrapped(i, j + 1)
    val d = wrapped(i + 1, j + 1)
    Rgb(
      lerp(ty, lerp(tx, a.r, b.r), lerp(tx, c.r, d.r)),
      lerp(ty, lerp(tx, a.g, b.g), lerp(tx, c.g, d.g)),
      lerp(ty, lerp(tx, a.b, b.b), lerp(tx, c.b, d.b))
    )

  private def wrapped(x: Int, y: Int): Rgb = pixel(column(x, y), row(x, y))

  def ofPixels(value: SphereImage.PixelValue): Array[Float] =
    val values = new Array[Float](Math.multiplyExact(width, height))
    val _ = everyPixel: (x, y, c) =>
      values(y * width + x) = value(c.r, c.g, c.b)
      true
    values

  def isLit: Boolean =
    !everyPixel((_, y, c) => !(c.max > 0f && layout.stretch((y + 0.5f) / height) > 0f))

  /** Visits the pixels until one does not hold, tile by tile: a tile that gave way to others is not
    * read again.
    */
  private inline def everyPixel(inline holds: (Int, Int, Rgb) => Boolean): Boolean =
    val texels = pixels.reader
    val (wide, high) = pixels.tile
    val (across, down) = ((width + wide - 1) / wide, (height + high - 1) / high)
    var allHold = true
    var tile = 0
    while allHold && tile < across * down do
      val (x0, y0) = (tile % across * wide, tile / across * high)
      var y = y0
      while allHold && y < Math.min(height, y0 + high) do
        var x = x0
        while allHold && x < Math.min(width, x0 + wide) do
          val i = pixels.index(x, y)
          allHold = holds(x, y, texelColor(Rgb(texels(i, 0), texels(i, 1), texels(i, 2))))
          x += 1
        y += 1
      tile += 1
    allHold
