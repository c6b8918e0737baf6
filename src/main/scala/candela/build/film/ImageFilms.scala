package candela.build

object ImageFilm extends FilmRecipe("image", "an image of red, green and blue", untilV3):
  private val scale = float("scale", "factor of all pixel values", onlyV3)(1f)
  private val most =
    float("maxsampleluminance", "brighter samples are scaled down", onlyV3)(Float.PositiveInfinity)
  noMeaning("no other program shows the image")(
    bool("display", "show the image while it is rendered", onlyV2)(false)
  )
  protected def make()(using Site): FilmSettings = settings(scale(), most())

object RgbFilm extends SensorFilm("rgb", "an image of red, green and blue")

/** Of films with more channels than are rendered. */
trait OnlyColors extends SensorFilm:
  override def pending: Option[String] = Some("only the channels R, G and B are written")

object GBufferFilm
    extends SensorFilm("gbuffer", "an image with positions, normals, albedo and more")
    with OnlyColors:
  declare(
    string("coordinatesystem", "of positions and normals: camera, world")("camera")
  )

object SpectralFilm extends SensorFilm("spectral", "an image of many wavelengths") with OnlyColors:
  declare(
    integer("nbuckets", "bands of wavelengths")(16),
    float("lambdamin", "shortest wavelength", unit = "nm")(360f),
    float("lambdamax", "longest wavelength", unit = "nm")(830f)
  )
