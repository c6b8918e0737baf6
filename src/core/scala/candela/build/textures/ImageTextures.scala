package candela.build.textures

import candela.base.Decimal
import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.{Encoding, Rgb}
import candela.image.{ExrLevels, ImageBands, StoredImage}
import candela.math.*
import candela.scenefile.{Dialect, Param, ParamType}
import candela.textures.*

import java.util.Locale

/** @param category what its texels are */
abstract class ImageMapRecipe[A](standIn: String, category: String)
    extends MappedRecipe[A]("imagemap", "image texture"):
  private val filename =
    string("filename", "image file: exr, pfm, hdr, png, qoi, tga, jpg …", shown = "none")("")
  private val wrapOfPbrt =
    oneOf("wrap", "wrap mode outside the image", ImageMapRecipe.Wraps)("repeat")
  private val wrapOfOthers =
    oneOf(
      "wrap",
      "wrap mode outside the image",
      ImageMapRecipe.Wraps :+ "mirror",
      onlyOthers
    )("repeat")
  private val wrapDown =
    oneOf("wrapt", "wrap mode along t, if it differs", WrapModes.Names, onlyGltf, shown = "`wrap`")(
      ""
    )
  private val pyramid = Once[FilteredLookup]()
  protected val scale = float("scale", "scale of the values")(1f)
  protected val invert = bool("invert", "invert values: 1 − value", onlyV4)(false)
  private val gammaNumber = float("gamma", "exponent that linearises values", onlyV2)(1f)
  private val gammaFlag =
    bool("gamma", "decode sRGB values", onlyV3, shown = "for .png and .tga")(true)
  private val encoding =
    string(
      "encoding",
      "encoding: sRGB, linear, or `gamma` and an exponent",
      onlyV4,
      shown = "\"sRGB\" for .png, else \"linear\""
    )("sRGB")
  private val filter =
    oneOf(
      "filter", "texture filter", ImageMapRecipe.FilterNames, onlyV4, forgiven = true
    )("bilinear")
  private val trilinear =
    bool("trilinear", "use trilinear instead of EWA filtering", untilV3)(false)
  private val anisotropy =
    float(
      "maxanisotropy",
      "maximum anisotropy: footprint length over width",
      range = Range(1f, 1000f).limited
    )(8f)

  /** The texels of an image of the scene. */
  protected def texels(image: ImageBands, decode: Float => Float)(using Site): TexelBands

  /** Likewise in memory, when the texture is first seen. */
  protected def whenSeen(stored: StoredImage, decode: Float => Float)(using Site): () => Texels

  /** How colours are chosen that stand for all of the texels, if they are colours. */
  protected def colors(texels: TexelBands): Option[ColorChoice]

  /** Notes them, if they decide how the scene is rendered. */
  protected def note(colors: => Vector[Rgb])(using Site): Unit

  /** Returns the image's lookup. Reports problems and returns None. */
  protected def lookup()(using site: Site): Option[FilteredLookup] =
    site.declaration.param("filename").filter(_ => filename().nonEmpty) match
      case None =>
        site.error(Code.MissingParameter, "an \"imagemap\" needs `filename`")
        None
      case Some(p) =>
        inFile(p).map(image => pyramid(filtered(MipMap.of(image.levels)))).orElse(generated(p))

  /** The image with the levels of its file, if there are some that can be used. */
  private def inFile(p: Param)(using site: Site): Option[CachedImage] =
    val ways = s"${this.ways} in the file"
    val image =
      if isPlain then None
      else
        site.resources.prepared(p, site, standIn, ways, wrapping)(usable): texels =>
          colors(TexelBands.of(texels)).fold(Vector.empty)(_.select(texels))
    for found <- image do
      note(found.facts.colors)
      site.resources.checkTexels(p, site, ways)(found.facts.odd)
    image

  /** The channels of the colours of levels in a file, if textures may use these as they are. */
  private def usable(levels: ExrLevels)(using site: Site): Either[Option[String], Vector[Int]] =
    val decode = decoding(Encoding.Linear)
    val names = levels.channelNames
    if !ImageMapRecipe.Probes.forall(x => decode(x) == x) then
      Left(Some("the texture changes texels, which is done before they are reduced"))
    else if site.dialect == Dialect.V4 && !levels.colorSpace.isSrgb then
      Left(Some("their primaries are not those of sRGB"))
    else
      StoredImage.colors(names).toRight(None).filterOrElse(
        isPicked,
        Some(s"the texture is not made of the channels ${names.mkString(", ")} as they are")
      )

  /** Whether texels are these channels as they are. */
  protected def isPicked(channels: Vector[Int])(using Site): Boolean

  /** The image with levels that are made. */
  private def generated(p: Param)(using site: Site): Option[FilteredLookup] =
    site.resources.textures.tiles match
      case Some(tiles) =>
        val cachedImage = site.resources.tiled(tiles, p, site, standIn, ways, wrapping): image =>
          val texels = this.texels(image, decoding(image.encoding))
          val limit = if isPlain then None else Some(maxValue(image.isBytes))
          MadeTexels(texels, limit, image.encoding, colors(texels))
        for image <- cachedImage yield
          val _ = decoding(image.encoding) // reports what is wrong
          note(image.facts.colors)
          site.resources.checkTexels(p, site, ways)(image.facts.odd)
          pyramid(filtered(MipMap.of(image.levels)))
      case None =>
        for stored <- site.resources.image(p, site.declaration, site.problems, standIn)
        yield pyramid:
          val decode = decoding(stored.encoding)
          val texels = whenSeen(stored, decode)
          val isBytes = ImageBands.of(stored).isBytes
          site.resources.checkTexels(p, site, ways):
            // Means of decoded bytes are numbers, too
            if isBytes && ImageMapRecipe.decodesBytes(decode) then None else texels().odd
          filtered:
            if isPlain then MipMap.plain(wrapping)(texels)
            else
              val (width, height) = (stored.width, stored.height)
              val limit = maxValue(isBytes)
              val (pool, keep) = (site.resources.pool, site.resources.cache)
              val key = site.resources.keyOf(p, site.declaration).map(k => s"$k $ways")
              MipMap.ofImage(width, height, wrapping, limit, pool, keep, key)(texels)

  /** What the texels of an image file depend on. */
  private def ways(using site: Site): String =
    val file = filename().toLowerCase(Locale.ROOT)
    val suffix = Seq(".png", ".tga").find(file.endsWith).mkString
    val decoding = site.dialect match
      case Dialect.V2 => s"${scale()} ${gammaNumber()}"
      case Dialect.V3 => s"${gammaFlag.given_()}"
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf => encoding()
    s"$category $choice${site.dialect} of ${site.rules.program} $suffix $decoding $wrapping " +
      (if isPlain then "plain" else "levels")

  /** What of the image is read. */
  protected def choice(using Site): String = ""

  private def wrapping(using Site): Wrap = wrap match
    case "black" => Wrap.Black
    case "octahedralsphere" => Wrap.OctahedralSphere
    case name => WrapModes.of(name, wrapDown())

  /** Images that are not filtered are neither enlarged nor reduced. */
  private def isPlain(using site: Site): Boolean =
    !site.rules.filters && !site.resources.settings.meanImages

  /** pbrt-v4 stores 8-bit images with 8 bits. */
  private def maxValue(isBytes: Boolean)(using site: Site): Float =
    if site.dialect == Dialect.V4 && isBytes then 1f else Float.PositiveInfinity

  private def filtered(levels: MipMap)(using site: Site): FilteredLookup =
    val dialect = site.dialect
    val bottomUp = dialect != Dialect.V2 || filename().toLowerCase(Locale.ROOT).endsWith(".tga")
    val isV4 = dialect == Dialect.V4
    val kind =
      if isV4 then filter().toLowerCase(Locale.ROOT) else if trilinear() then "trilinear" else "ewa"
    site.resources.askForFootprints(s"$kind image textures")
    val pyramid = if site.resources.settings.meanImages then MipMap.ofMean(levels) else levels
    kind match
      case "point" => LevelLookup(pyramid, interpolates = false, bottomUp, turned = !isV4)
      case "bilinear" => LevelLookup(pyramid, interpolates = true, bottomUp, turned = !isV4)
      case "trilinear" =>
        val factor = if dialect == Dialect.V3 then 1f else 2f
        TrilinearLookup(pyramid, factor, fromSecond = isV4, bottomUp, turned = !isV4)
      case _ => EwaLookup(pyramid, anisotropy(), bottomUp, turned = !isV4)

  private def decoding(stored: Encoding)(using site: Site): Float => Float =
    site.dialect match
      case Dialect.V2 =>
        // v2 scales before the exponent; `scale` must not be applied twice
        val (s, g) = (scale(), gammaNumber())
        x => pow(s * x, g)
      case Dialect.V3 =>
        val eightBit = Seq(".png", ".tga").exists(filename().toLowerCase(Locale.ROOT).endsWith)
        val isNumber = site.declaration.param("gamma").exists(_.paramType == ParamType.Float)
        if isNumber then
          site.warn(Code.IdleParameter, "`gamma` must be a bool in v3; the number is ignored")
        val flag = if isNumber then None else gammaFlag.given_()
        if flag.getOrElse(eightBit) then Encoding.Srgb.decode(_) else identity
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf =>
        // Floating-point images are linear; in pbrt, `encoding` applies to PNG, all else is sRGB
        val isOpen = site.rules.decodesAll && stored != Encoding.Linear
        if isOpen || filename().toLowerCase(Locale.ROOT).endsWith(".png") then encoded()
        else if stored == Encoding.Linear then identity
        else Encoding.Srgb.decode(_)

  private def encoded()(using site: Site): Float => Float =
    encoding().split(' ') match
      case Array("sRGB") => Encoding.Srgb.decode(_)
      case Array("linear") => identity
      case Array("gamma", g) if Decimal.float(g).exists(_ > 0f) =>
        val exponent = g.toFloat
        x => pow(x, exponent)
      case _ =>
        val name = encoding()
        site.error(
          Code.ParameterValue,
          s"`encoding` must be sRGB, linear, or gamma and a number, found \"$name\""
        )
        identity

  private def wrap(using site: Site): String =
    if Dialect.ofOthers(site.rules.dialect) then wrapOfOthers() else wrapOfPbrt()

  /** With which the image repeats. */
  protected def period(using Site): Double = wrap match
    case "repeat" => 1
    case "mirror" => 2
    case _ => 0

  protected def outerScale(using site: Site): Float =
    if site.dialect == Dialect.V2 then 1f else scale()

object FloatImageMapRecipe extends ImageMapRecipe[FloatTexture](StandIns.Ones, "numbers"):
  private val channel = oneOf(
    "channel",
    "channel of the image whose values these are, instead of the luminance; opacity: alpha other " +
      "than 1, else the mean of the colours",
    Vector("all", "r", "g", "b", "a", "opacity"),
    onlyGltf
  )("all")

  override protected def choice(using Site): String = channel()
  protected def create()(using site: Site): FloatTexture =
    lookup().fold(StandIns.number)(FloatImageTexture(mapped(period), _, outerScale, invert()))

  protected def texels(image: ImageBands, decode: Float => Float)(using site: Site): TexelBands =
    channel() match
      case "all" => site.rules.toNumber(image, decode)
      case "opacity" => Texels.meanOrAlpha(image, decode)
      case name => Texels.channel(image, name.toUpperCase(Locale.ROOT), decode)

  protected def whenSeen(stored: StoredImage, decode: Float => Float)(using Site): () => Texels =
    val _ = stored.colorChannels // an error without any
    () => texels(ImageBands.of(stored), decode).inMemory

  protected def colors(texels: TexelBands): Option[ColorChoice] = None
  protected def isPicked(channels: Vector[Int])(using Site): Boolean =
    channels.distinct.size == 1 && channel() == "all"
  protected def note(colors: => Vector[Rgb])(using Site): Unit = ()

object RgbImageMapRecipe extends ImageMapRecipe[RgbTexture](StandIns.Magentas, "colours"):
  protected def create()(using site: Site): RgbTexture =
    val basis = site.resources.basis
    lookup().fold(StandIns.color(basis)): lookup =>
      val image = RgbImageTexture(mapped(period), lookup, outerScale, invert())
      if basis.isSrgb then image else RebasedTexture(image, basis.lookUp)

  protected def whenSeen(stored: StoredImage, decode: Float => Float)(using Site): () => Texels =
    val texelsInMemory = texels(ImageBands.of(stored), decode).inMemory
    note(colors(TexelBands.of(texelsInMemory)).fold(Vector.empty)(_.select(texelsInMemory)))
    () => texelsInMemory

  protected def colors(texels: TexelBands): Option[ColorChoice] =
    Option.when(texels.channels == 3):
      ColorCensus.choiceOf(texels.width.toLong * texels.height)

  protected def isPicked(channels: Vector[Int])(using Site): Boolean = true

  protected def note(colors: => Vector[Rgb])(using site: Site): Unit =
    site.resources.counting.foreach(_.addColors(colors, SpectrumRole.Reflectance))

  /** pbrt-v4 alone knows other colour spaces. */
  protected def texels(image: ImageBands, decode: Float => Float)(using site: Site): TexelBands =
    val isConverted = site.dialect == Dialect.V4 && !image.colorSpace.isSrgb
    Texels.color(if isConverted then image.toReflectances else image, decode)

private object ImageMapRecipe:
  /** Numbers that only what changes nothing leaves as they are. */
  val Probes: Vector[Float] = Vector(0f, 0.1f, 0.5f, 1f, 3f)

  /** Whether all bytes are numbers then. */
  def decodesBytes(decode: Float => Float): Boolean =
    (0 to 255).forall(code => java.lang.Float.isFinite(decode(code / 255f)))

  val Wraps: Vector[String] = Vector("repeat", "black", "clamp", "octahedralsphere")
  val FilterNames: Vector[String] = Vector("point", "bilinear", "trilinear", "ewa", "EWA")

/** Wrap modes of images whose axes may have different ones. */
private[build] object WrapModes:
  val Names: Vector[String] = Vector("repeat", "clamp", "mirror")

  /** @param down that along t; any other name than these: as `across` */
  def of(across: String, down: String): Wrap =
    val first = mode(across)
    Wrap.of(first, if Names.contains(down) then mode(down) else first)

  private def mode(name: String): Wrap = name match
    case "clamp" => Wrap.Clamp
    case "mirror" => Wrap.Mirror
    case _ => Wrap.Repeat

/** Per-face textures, without texture coordinates. */
abstract class PtexRecipe[A] extends Recipe[A]("ptex", "Ptex per-face texture", sinceV3):
  declare(
    string("filename", ".ptx file", shown = "none")(""),
    float("gamma", "exponent that linearises values", onlyV3)(2.2f),
    string("encoding", "encoding: sRGB, linear, or `gamma` and an exponent", onlyV4)("gamma 2.2"),
    float("scale", "scale of the values", onlyV4)(1f)
  )

object FloatPtexRecipe extends PtexRecipe[FloatTexture] with HalfFloat
object RgbPtexRecipe extends PtexRecipe[RgbTexture] with HalfRgb
