package candela.build.lights

import candela.base.Code

import candela.build.recipe.*
import candela.color.{ColorBasis, Rgb}
import candela.image.{Image, ImageError}
import candela.lights.{IesError, IesFile}
import candela.scenefile.Dialect

/** Loads the images of lights. */
private[build] object LightImages:

  /** The image of a statement, which has one at most. */
  private val images = Once[Option[Image]]()

  /** Returns the image named by the string parameter `name`, in the scene's basis. Reports images
    * that can't be used.
    *
    * pbrt-v2 and v3 treat the values of 8-bit files as linear; v4 and Mitsuba decode them. v2
    * reads the rows of TGA files bottom-up.
    */
  def read(name: String)(using site: Site): Option[Image] =
    // Each basis has its own copy, but lookups convert the colours of sRGB to wavelengths
    val basis = site.resources.basis
    if basis.isSpectral then images(loaded(name))
    else loaded(name)

  /** Returns the lamp of the photometric file that the string parameter `name` names, as an
    * equirectangular image. Reports files that can't be used.
    */
  def lamp(name: String)(using site: Site): Option[Image] =
    images:
      for
        p <- site.declaration.param(name)
        file <- site.resources.file(p, site.declaration, site.problems, StandIns.LeftOut)
        image <-
          try
            val lamp = IesFile.read(file)
            lamp.notes.foreach(site.problems.warn(Code.ImageContents, p.valuesAt, _))
            Some(lamp.photometry.image)
          catch
            case e: IesError =>
              site.problems.missing(Code.MeasuredFile, p.valuesAt, e.getMessage, StandIns.LeftOut)
              None
      yield image

  private def loaded(name: String)(using site: Site): Option[Image] =
    for
      p <- site.declaration.param(name)
      stored = site.resources.image(p, site.declaration, site.problems).getOrElse(StandIns.picture)
      image <- usable(stored.toImage, m => site.problems.error(Code.ImageContents, p.valuesAt, m))
    yield
      val isFromBelow = site.dialect == Dialect.V2 && isTga(p.strings.headOption.getOrElse(""))
      site.resources.counting.foreach:
        _.addImage(image.data.length / 3, SpectrumRole.Emission): i =>
          Rgb(image.data(3 * i), image.data(3 * i + 1), image.data(3 * i + 2))
      rebased(if isFromBelow then image.upsideDown else image, site.resources.basis)

  private def isTga(file: String): Boolean = file.toLowerCase.endsWith(".tga")

  /** Rows at the poles alone have no area: those between are added. */
  def withEquator(image: Image): Image =
    if image.height > 2 then image
    else
      val row = 3 * image.width
      val (top, bottom) = (image.data.take(row), image.data.takeRight(row))
      val middle = top.lazyZip(bottom).map((a, b) => 0.5f * (a + b))
      Image(image.width, 3, image.channelNames, top ++ middle ++ bottom)

  private def usable(image: Image, fail: String => Unit)(using site: Site): Option[Image] =
    val linear =
      if site.rules.decodesLights then image.linear
      else Image(image.width, image.height, image.channelNames, image.data)
    try
      val rgb = linear.toRgb
      // Sums of brighter pixels overflow
      if areUsable(rgb.data) then Some(rgb)
      else
        fail("the image of a light has pixels that are NaN, infinite, or above 1e30")
        None
    catch
      case e: ImageError =>
        fail(e.getMessage)
        None

  private def areUsable(values: Array[Float]): Boolean =
    var i = 0
    while i < values.length && Math.abs(values(i)) < Brightest do i += 1
    i == values.length

  /** Checks that an equal-area map is square. Reports an error otherwise. */
  def isSquare(image: Image)(using site: Site): Boolean =
    val isSquare = image.width == image.height
    if !isSquare then
      site.error(
        Code.ImageContents,
        s"an equal-area map must be square, found ${image.width}×${image.height} pixels",
        Some("`candela image IN OUT --environment equalarea` converts an equirectangular image")
      )
    isSquare

  /** Replaces the components of each pixel by the mean of those in the file. */
  def gray(image: Image)(using site: Site): Image =
    val basis = site.resources.basis
    val isAsInFile = basis.isSrgb || basis.isSpectral
    image.mapped(c => Rgb.gray((if isAsInFile then c else basis.toSrgb(c)).average))

  private def rebased(image: Image, basis: ColorBasis): Image =
    if basis.isSrgb || basis.isSpectral then image else image.mapped(basis.fromSrgb)

  /** Conversion of the colours that lookups return, if it can't be done once for the image. */
  def conversion(using site: Site): Option[Rgb => Rgb] =
    val basis = site.resources.basis
    Option.when(basis.isSpectral)(basis.lookUpLight)

  private val Brightest = 1e30f
