package candela.build.lights

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.{ColorBasis, Encoding, Rgb}
import candela.image.{Image, ImageBands, ImageError, StoredImage}
import candela.lights.{IesError, IesFile, Picture, PictureLookup}
import candela.textures.{FloatTexels, MadeTexels, TexelBands, TileCache, Wrap}

/** Loads the images of lights. */
private[build] object LightImages:

  private val photometries = Once[Option[Image]]()

  private val images = Once[Either[ImageError, Image]]()
  private val pictures = Once[Picture]()
  private val luminances = Once[Float]()

  /** Returns the image named by the string parameter `name`, in the scene's basis. Reports images
    * that can't be used.
    *
    * pbrt-v2 and v3 treat the values of 8-bit files as linear; v4 and Mitsuba decode them. v2
    * reads the rows of TGA files bottom-up.
    */
  def read(name: String)(using site: Site): Option[Image] =
    for
      p <- site.declaration.param(name)
      stored = site.resources.image(p, site.declaration, site.problems).getOrElse(StandIns.picture)
    yield
      // Lookups convert the colours of sRGB to wavelengths; other bases have a copy each
      val basis = Option(site.resources.basis).filterNot(_.isSpectral)
      images.of((stored, isDecoded, isFromBelow, basis))(loaded(stored, name)) match
        case Right(image) => image
        case Left(e) =>
          site.problems.missing(e.code, p.valuesAt, e.getMessage, StandIns.Magentas)
          StandIns.picture.toImage.toRgb

  /** Mean luminance of the image named by the string parameter `name`, in the plain basis. */
  def luminance(name: String, picture: Picture)(using site: Site): Float =
    val basis = site.resources.basis
    luminances.of((site.declaration.folder, site.declaration.param(name).map(_.strings))):
      picture.mean((c, _, _) => basis.toSrgb(c).luminance)

  /** The flat image named by the string parameter `name`, as [[read]]. */
  def picture(name: String, lookup: PictureLookup)(using site: Site): Option[Picture] =
    read(name).map: image =>
      pictures.of((image, lookup, site.resources.basis))(Picture(image, lookup, conversion))

  /** The image of an environment that the string parameter `name` names, as [[read]]; in tiles, if
    * images of lights are kept so.
    */
  def environment(name: String)(using site: Site): Option[EnvironmentImage] =
    def inMemory = read(name).map(EnvironmentImage.InMemory(_, contents(name)))
    site.resources.textures.lightTiles match
      case Some(tiles) if TextureStore.mayBeTiled(site.declaration, site.dialect) =>
        tiled(tiles, name).orElse(inMemory)
      case _ => inMemory

  /** What tells the image from others, if it is kept for other scenes. */
  private def contents(name: String)(using site: Site): Option[String] =
    for
      p <- site.declaration.param(name)
      content <- site.resources.keyOf(p, site.declaration)
    yield s"$content ${isDecoded} $isFromBelow"

  /** None with a problem, and of images that have too few rows. */
  private def tiled(tiles: TileCache, name: String)(using site: Site): Option[EnvironmentImage] =
    val ways = s"pixels of lights ${isDecoded}"
    def texels(bands: ImageBands) = TexelBands(bands, 3, Array.emptyFloatArray): band =>
      usable(band, name) match
        case Right(rgb) => FloatTexels(rgb.width, rgb.height, 3, rgb.data)
        case Left(e) => throw e
    for
      p <- site.declaration.param(name)
      image <- site.resources.tiled(tiles, p, site, StandIns.Magentas, ways, Wrap.Clamp): bands =>
        val choice = ColorCensus.choiceOf(bands.width.toLong * bands.height)
        MadeTexels(texels(bands), None, Encoding.Linear, Some(choice))
      if image.levels.head.height > FewRows
      key <- site.resources.keyInTiles(p, site.declaration, ways)
    yield
      site.resources.counting.foreach(_.addColors(image.facts.colors, SpectrumRole.Emission))
      EnvironmentImage.InTiles(image.levels.head, rebasing(site.resources.basis), key)

  /** Returns the intensity of the photometric file that the string parameter `name` names, as an
    * equirectangular image. Reports files that can't be used.
    */
  def photometry(name: String)(using site: Site): Option[Image] =
    site.declaration.param(name).flatMap: p =>
      photometries.of((site.declaration.folder, p.strings)):
        for
          file <- site.resources.file(p, site.declaration, site.problems, StandIns.LeftOut)
          image <-
            try
              val light = IesFile.read(file)
              light.notes.foreach(site.problems.warn(Code.ImageContents, p.valuesAt, _))
              Some(light.photometry.image)
            catch
              case e: IesError =>
                site.problems.missing(Code.MeasuredFile, p.valuesAt, e.getMessage, StandIns.LeftOut)
                None
        yield image

  private def loaded(stored: StoredImage, name: String)(using site: Site) =
    usable(stored, name).map: image =>
      site.resources.counting.foreach:
        _.addImage(image.data.length / 3, SpectrumRole.Emission): i =>
          Rgb(image.data(3 * i), image.data(3 * i + 1), image.data(3 * i + 2))
      val upright = if isFromBelow then image.upsideDown else image
      // Large ones are held once
      def target = stored match
        case _: Image => new Array[Float](upright.data.length)
        case _ => upright.data
      rebasing(site.resources.basis).fold(upright)(change => upright.mapped(change(_), target))

  /** What the parameter `raw` of lights with images means. */
  val Raw: String = "whether values of 8-bit images are linear"

  private def isDecoded(using site: Site): Boolean =
    site.rules.decodesLights && !site.declaration.param("raw").exists(_.bools.contains(true))

  private def isFromBelow(using site: Site): Boolean =
    TextureStore.isFromBelow(site.declaration, site.dialect)

  /** Rows at the poles alone have no area: those between are added. */
  def withEquator(image: Image): Image =
    if image.height > FewRows then image
    else
      val row = 3 * image.width
      val (top, bottom) = (image.data.take(row), image.data.takeRight(row))
      val middle = top.lazyZip(bottom).map((a, b) => 0.5f * (a + b))
      Image(image.width, 3, image.channelNames, top ++ middle ++ bottom)

  private def usable(image: StoredImage, name: String)(using
      site: Site
  ): Either[ImageError, Image] =
    def undecoded = Image(image.width, image.height, image.channelNames, image.toImage.data)
    try
      val rgb = if isDecoded then image.toRgb else undecoded.toRgb
      // Sums of brighter pixels overflow
      val i = firstUnusable(rgb.data)
      def file = site.declaration.param(name).flatMap(_.strings.headOption).getOrElse("")
      def pixel = s"(${i / 3 % rgb.width}, ${i / 3 / rgb.width})"
      def reason =
        s"$file: the image of a light has pixels that are NaN, infinite, or above 1e30: " +
          s"the first, at $pixel, is ${rgb.data(i)}"
      Either.cond(i == rgb.data.length, rgb, ImageError(Code.ImageContents, reason))
    catch case e: ImageError => Left(e)

  private def firstUnusable(values: Array[Float]): Int =
    var i = 0
    while i < values.length && Math.abs(values(i)) < Brightest do i += 1
    i

  /** Makes an equal-area map of an equirectangular one. */
  val EqualArea: String =
    "`candela image IN --outfile OUT --environment equalarea` converts an equirectangular image"

  /** Checks that an equal-area map is square. Reports an error otherwise. */
  def isSquare(width: Int, height: Int)(using site: Site): Boolean =
    val isSquare = width == height
    if !isSquare then
      site.error(
        Code.ImageContents,
        s"an equal-area map must be square, found $width×$height pixels",
        Some(EqualArea)
      )
    isSquare

  /** Replaces the components of each pixel by the mean of those in the file. */
  def gray(image: Image)(using site: Site): Image =
    val basis = site.resources.basis
    val isAsInFile = basis.isSrgb || basis.isSpectral
    image.mapped(c => Rgb.gray((if isAsInFile then c else basis.toSrgb(c)).average))

  /** Makes the components of a basis, if they are not those of the image. */
  private def rebasing(basis: ColorBasis): Option[Rgb => Rgb] =
    Option.when(!basis.isSrgb && !basis.isSpectral)(basis.fromSrgb(_))

  /** Conversion of the colours that lookups return, if it can't be done once for the image. */
  def conversion(using site: Site): Option[Rgb => Rgb] =
    val basis = site.resources.basis
    Option.when(basis.isSpectral)(basis.lookUpLight)

  private val Brightest = 1e30f

  /** Of which none is between the poles. */
  private val FewRows = 2
