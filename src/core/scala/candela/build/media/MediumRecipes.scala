package candela.build.media

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.{Colorimetry, Rgb, Spectrum}
import candela.color.Colorimetry.White
import candela.math.{Transform, Vec3}
import candela.media.*

object HomogeneousRecipe
    extends MediumRecipe("homogeneous", "homogeneous medium", sinceV3)
    with HasPreset
    with HasScale:
  private val emitted =
    color(
      "Le", "emitted radiance", SpectrumRole.Emission, onlyV4, "W/(m² sr)", "none", Held
    )(Rgb.Black)
  private val emittedScale =
    float("Lescale", "scale of the emission", onlyV4, range = Coefficients)(1f)

  protected def create()(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    val le = notNegative(emitted() * emittedScale())
    // Three wavelengths of a spectral rendering may be black in a medium that is not
    Option.unless(site.resources.isPlain && (absorption + scattering).isBlack)(
      HomogeneousMedium(absorption, scattering, le, phase())
    )

object HeterogeneousRecipe
    extends MediumRecipe("heterogeneous", "density grid", onlyV3)
    with HasPreset
    with HasScale
    with HasGrid
    with HasBox:
  private val densities =
    Samples(densityOfCells)

  protected def create()(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    val t = absorption + scattering
    if t.r != t.g || t.g != t.b then
      site.warn(
        Code.AsInPbrt,
        s"extinction differs between colours ($t); using it per colour, whereas pbrt-v3 uses red " +
          "for all"
      )
    for
      map <- toUnit()
      density <- densities()
    yield GridMedium(map, density, absorption, scattering, None, phase())

object UniformGridRecipe
    extends MediumRecipe("uniformgrid", "density grid", onlyV4)
    with HasScale
    with HasGrid
    with FillsBox
    with HasTemperature:
  private val densities =
    Samples(densityOfCells)
  private val temperature =
    numbers(
      "temperature",
      "float[]",
      "temperature of each cell, for thermal emission",
      unit = "K",
      range = Cells
    )
  private val emittedScale =
    numbers("Lescale", "float[]", "scale of each cell's emission", shown = "1", range = Cells)
  private val (heat, scales) = (Samples(temperature), Samples(emittedScale))
  private val emitted =
    color(
      "Le", "emitted radiance", SpectrumRole.Emission, onlyV4, "W/(m² sr)", "none", Held
    )(Rgb.Black)

  protected def create()(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    for
      map <- toUnit()
      density <- densities()
      light <- glow()
    yield placed(map)(GridMedium(_, density, absorption, scattering, light, phase()))

  /** The emission, if any. Returns None after an error. */
  private def glow()(using site: Site): Option[Option[Glow]] =
    val (temperatures, factors) = (temperature(), emittedScale())
    val le = notNegative(emitted())
    val scale =
      if factors.isEmpty then Some(SampledGrid.One)
      else scales()
    if temperatures.nonEmpty && emitted.given_().isDefined then
      site.error(
        Code.ExclusiveParameters,
        "`Le` and `temperature` of a medium are mutually exclusive"
      )
      None
    else if temperatures.nonEmpty then
      for
        s <- scale
        t <- heat()
      yield
        val (below, factor) = kelvins()
        val hottest = (t.maximum - below) * factor
        Some(ThermalGlow(t, below, factor, Thermal.colors(hottest), s))
    else scale.map(s => Option.unless(le.isBlack)(ColoredGlow(le, s)))

object RgbGridRecipe
    extends MediumRecipe("rgbgrid", "grid of RGB coefficients", onlyV4)
    with HasGrid
    with FillsBox:
  private val Shares = Range(0f, 1f).limited
  private val sigmaA =
    numbers(
      "sigma_a",
      "rgb[]",
      "absorption coefficient of each cell",
      unit = PerUnit,
      shown = "1",
      range = Cells
    )
  private val sigmaS =
    numbers(
      "sigma_s",
      "rgb[]",
      "scattering coefficient of each cell",
      unit = PerUnit,
      shown = "1",
      range = Cells
    )
  private val emitted =
    numbers("Le", "rgb[]", "emitted radiance of each cell", unit = "W/(m² sr)", range = Cells)
  private val scale = float("scale", "factor of the coefficients", range = Coefficients)(1f)
  private val emittedScale =
    float("Lescale", "scale of the emission", onlyV4, range = Coefficients)(1f)
  private val albedo =
    numbers("albedo", "rgb[]", "scattered part, by a grid of its own", onlyMitsuba, range = Shares)
  private val albedoSize = integers("albedosize", "its cells along x, y and z", onlyMitsuba)
  private val albedoPlace =
    numbers("albedoplace", "float[]", "matrix from this grid's unit cube to its", onlyMitsuba)

  protected def create()(using site: Site): Option[Medium] =
    val (a, s, le) = (
      colors(sigmaA(), SpectrumRole.Unbounded),
      colors(sigmaS(), SpectrumRole.Unbounded),
      colors(emitted(), SpectrumRole.Emission)
    )
    if a.isEmpty && s.isEmpty then
      site.error(Code.MissingParameter, "an \"rgbgrid\" needs `sigma_a`, `sigma_s` or both")
      None
    else if a.isEmpty && le.nonEmpty then
      site.error(
        Code.MissingParameter,
        "an emissive medium must absorb; an \"rgbgrid\" with `Le` needs `sigma_a`"
      )
      None
    else
      // Following pbrt-v4, this emission is not normalised to the luminance of the colours
      val brightness = emittedScale() * Thermal.LuminousIntegral
      val light = if brightness > 0f then le.map(_ * brightness) else Array.emptyFloatArray
      for
        map <- toUnit()
        absorption <- grid("sigma_a", a)
        scattering <- grid("sigma_s", s)
        glow <- grid("Le", light)
        size <- absorption.orElse(scattering)
      yield placed(map): toUnit =>
        ColorGridMedium(
          toUnit,
          size.r,
          absorption,
          scattering,
          constant = 1f,
          scale(),
          glow,
          phase(),
          shares()
        )

  private def shares()(using site: Site): Option[AlbedoGrid] =
    val values = colors(albedo(), SpectrumRole.Reflectance)
    val rows = albedoPlace().map(_.toDouble).toVector
    for place <- Option.when(values.nonEmpty)(rows).flatMap(Transform.fromRows) yield
      val Array(nx, ny, nz) = albedoSize(): @unchecked
      val Vector(r, g, b) = Vector.tabulate(3): c =>
        val channel = Array.tabulate(values.length / 3)(i => values(3 * i + c))
        SampledGrid(nx, ny, nz, channel, site.rules.gridEdge)
      AlbedoGrid(ColorGrid(r, g, b), place)

  private def colors(values: Array[Float], role: SpectrumRole)(using site: Site): Array[Float] =
    values.grouped(3).flatMap { v =>
      if v.length < 3 then v
      else
        val c = Spectra.ofMany(Rgb(v(0), v(1), v(2)), role, site)
        Array(c.r, c.g, c.b)
    }.toArray

  /** The grid, if any. Returns None after an error. */
  private def grid(name: String, values: Array[Float])(using Site): Option[Option[ColorGrid]] =
    if values.isEmpty then Some(None)
    else grids(name, values, channels = 3).map(g => Some(ColorGrid(g(0), g(1), g(2))))

object CloudRecipe
    extends MediumRecipe("cloud", "procedural cloud of noise", onlyV4)
    with HasCoefficients
    with HasBox:
  private val density = float("density", "scale of the density", range = Coefficients)(1f)
  private val wispiness = float("wispiness", "wispiness of the edges")(1f)
  private val frequency = float("frequency", "frequency of the noise")(5f)

  protected def create()(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    val (low, high): (Vec3, Vec3) = corners(sorted = true)
    toUnit().map: map =>
      CloudMedium(
        map,
        low,
        high - low,
        absorption,
        scattering,
        density(),
        wispiness(),
        frequency(),
        phase()
      )

/** How temperatures of a grid become kelvins. */
trait HasTemperature extends Fields:
  private val offset =
    float("temperatureoffset", "offset subtracted from temperatures", unit = "K")(0f)
  private val cutoff = float(
    "temperaturecutoff",
    "alias of `temperatureoffset`",
    unit = "K",
    shown = "temperatureoffset"
  )(0f)
  private val scaling = float("temperaturescale", "scale of temperatures")(1f)

  /** What is subtracted, and the scale of the difference. */
  protected def kelvins()(using Site): (Float, Float) =
    (offset.given_().getOrElse(cutoff()), scaling())

/** Thermal emission of pbrt-v4's media. */
private[build] object Thermal:

  /** ∫ ȳ(λ) dλ in nm, of the CIE 1931 observer. pbrt-v4 omits the division by it, which makes this
    * emission brighter.
    */
  val LuminousIntegral = 106.856895f

  /** Colours of black bodies in a basis; each spectrum has a maximum of 1. */
  def colors(hottest: Float)(using site: Site): ThermalColors =
    ThermalColors(
      hottest,
      kelvin =>
        val body = Spectrum.blackbody(kelvin)
        val c = Colorimetry.rgb(body, White.EqualEnergy)
        site.resources.basis.ofLight(body(_), c * LuminousIntegral): Rgb
    )
