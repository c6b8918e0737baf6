package candela.build.lights

import candela.base.loop
import candela.build.recipe.*
import candela.color.{ColorBasis, Rgb}
import candela.image.{Image, ImageError}
import candela.scenefile.Dialect

/** The images of lights. */
private[build] object LightImages:

  /** The image that the string parameter `name` gives, in the basis of the scene; a problem that
    * makes it unusable is reported.
    *
    * pbrt-v2 and v3 take the numbers of 8-bit files for linear ones; v4 decodes them. v2 has the
    * rows of TGA files from the bottom.
    */
  def read(name: String)(using site: Site): Option[Image] =
    for
      p <- site.declaration.param(name)
      stored = site.resources.image(p, site.declaration, site.problems).getOrElse(StandIns.picture)
      image <- usable(stored.toImage, m => site.problems.error(p.valuesAt, m))
    yield
      val isFromBelow = site.dialect == Dialect.V2 && isTga(p.strings.headOption.getOrElse(""))
      rebased(if isFromBelow then upsideDown(image) else image, site.resources.basis)

  private def isTga(file: String): Boolean = file.toLowerCase.endsWith(".tga")

  private def upsideDown(image: Image): Image =
    val row = 3 * image.width
    val data = new Array[Float](image.data.length)
    loop(image.height): y =>
      System.arraycopy(image.data, y * row, data, data.length - (y + 1) * row, row)
    Image(image.width, image.height, image.channelNames, data)

  private def usable(image: Image, fail: String => Unit)(using site: Site): Option[Image] =
    val linear =
      if site.dialect == Dialect.V4 then image.linear
      else Image(image.width, image.height, image.channelNames, image.data)
    try
      val rgb = linear.toRgb
      if rgb.data.forall(java.lang.Float.isFinite(_)) then Some(rgb)
      else
        fail("the image of a light has pixels that are infinite or no numbers")
        None
    catch
      case e: ImageError =>
        fail(e.getMessage)
        None

  /** Is the equal-area map square, as it must be? An error otherwise. */
  def isSquare(image: Image)(using site: Site): Boolean =
    val isSquare = image.width == image.height
    if !isSquare then
      site.error(
        s"the image is ${image.width}×${image.height}; an equal-area map is square",
        Some("pbrt-v4's `imgtool makeequiarea` turns an equirectangular image into one")
      )
    isSquare

  /** Each pixel three times the mean of its components. */
  def gray(image: Image): Image =
    mapped(image)(c => Rgb.gray(c.average))

  private def rebased(image: Image, basis: ColorBasis): Image =
    if basis.isSrgb then image else mapped(image)(basis.fromSrgb)

  private def mapped(image: Image)(f: Rgb => Rgb): Image =
    val data = new Array[Float](image.data.length)
    loop(data.length / 3): i =>
      val c = f(Rgb(image.data(3 * i), image.data(3 * i + 1), image.data(3 * i + 2)))
      data(3 * i) = c.r
      data(3 * i + 1) = c.g
      data(3 * i + 2) = c.b
    Image(image.width, image.height, image.channelNames, data)
