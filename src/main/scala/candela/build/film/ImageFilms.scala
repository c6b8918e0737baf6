package candela.build.film

import candela.build.recipe.*
import candela.film.{Development, Layer, SampleLimit, SpectralBands}

object ImageFilmRecipe extends FilmRecipe("image", "an image of red, green and blue", untilV3):
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

object RgbFilmRecipe extends SensorFilmRecipe("rgb", "an image of red, green and blue")

object GBufferFilmRecipe
    extends SensorFilmRecipe("gbuffer", "an image with positions, normals, albedo and more"):
  private val space = oneOf(
    "coordinatesystem",
    "of positions and normals",
    Vector("camera", "world")
  )("camera")
  override protected def make()(using Site): FilmSettings =
    super.make().copy(layers = Layer.gbuffer, layersInWorld = space() == "world")

object SpectralFilmRecipe extends SensorFilmRecipe("spectral", "an image of many wavelengths"):
  private val buckets = integer("nbuckets", "bands of wavelengths")(16)
  private val shortest = float("lambdamin", "shortest wavelength", unit = "nm")(360f)
  private val longest = float("lambdamax", "longest wavelength", unit = "nm")(830f)

  override protected def make()(using site: Site): FilmSettings =
    val (from, to) = (shortest(), longest())
    if buckets() < 1 then site.error(s"`nbuckets` is 1 or more; found ${buckets()}")
    if !(from >= 360f && from < to && to <= 830f) then
      site.error(s"`lambdamin` and `lambdamax` lie between 360 and 830 nm; found $from and $to")
    site.warn(
      "light has three components here, no wavelengths: bands are those of a smooth spectrum of " +
        "each pixel's colour"
    )
    val made = super.make()
    val bands = SpectralBands(Math.max(buckets(), 1), from, to)
    made.copy(development = made.development.copy(bands = Some(bands)))
