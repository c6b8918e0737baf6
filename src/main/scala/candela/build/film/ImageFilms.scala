package candela.build

import candela.film.{Development, Layer, SampleLimit}

object ImageFilm extends FilmRecipe("image", "an image of red, green and blue", untilV3):
  private val scale = float("scale", "factor of all pixel values", onlyV3)(1f)
  private val most =
    float("maxsampleluminance", "brighter samples are scaled down", onlyV3)(Float.PositiveInfinity)
  noMeaning("no other program shows the image")(
    bool("display", "show the image while it is rendered", onlyV2)(false)
  )
  protected def make()(using Site): FilmSettings =
    settings(
      Development(scale(), clipsNegative = true),
      _ => SampleLimit.luminance(most())
    )

object RgbFilm extends SensorFilm("rgb", "an image of red, green and blue")

object GBufferFilm
    extends SensorFilm("gbuffer", "an image with positions, normals, albedo and more"):
  private val space = oneOf(
    "coordinatesystem",
    "of positions and normals",
    Vector("camera", "world")
  )("camera")
  override protected def make()(using Site): FilmSettings =
    super.make().copy(layers = Layer.gbuffer, layersInWorld = space() == "world")

object SpectralFilm extends SensorFilm("spectral", "an image of many wavelengths"):
  override def pending: Option[String] =
    Some("light has three components here, no wavelengths; only R, G and B are written")
  declare(
    integer("nbuckets", "bands of wavelengths")(16),
    float("lambdamin", "shortest wavelength", unit = "nm")(360f),
    float("lambdamax", "longest wavelength", unit = "nm")(830f)
  )
