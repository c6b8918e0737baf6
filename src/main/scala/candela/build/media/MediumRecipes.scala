package candela.build.media

import candela.build.recipe.*
import candela.color.{Colorimetry, Rgb, Spectrum}
import candela.color.Colorimetry.White
import candela.math.Vec3
import candela.media.*

object HomogeneousRecipe
    extends MediumRecipe("homogeneous", "the same everywhere", sinceV3)
    with HasPreset
    with HasScale:
  private val emitted =
    color("Le", "emitted radiance", SpectrumRole.Emission, onlyV4, "W/(m² sr)", "none")(Rgb.Black)
  private val emittedScale = float("Lescale", "factor of what is emitted", onlyV4)(1f)

  protected def make()(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    val le = held(emitted() * emittedScale(), "Le")
    Option.unless((absorption + scattering).isBlack)(
      HomogeneousMedium(absorption, scattering, le, phase())
    )

object HeterogeneousRecipe
    extends MediumRecipe("heterogeneous", "a grid of densities", onlyV3)
    with HasPreset
    with HasScale
    with HasGrid
    with HasBox:
  private val density = numbers("density", "float[]", "nx by ny by nz densities, x first")

  protected def make()(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    val t = absorption + scattering
    if t.r != t.g || t.g != t.b then
      site.warn(
        s"extinction differs between colours ($t): each has its own here, while pbrt-v3 takes " +
          "that of red for all"
      )
    for
      map <- toUnit()
      grids <- samples("density", density())
    yield GridMedium(map, grids.head, absorption, scattering, None, phase())

object UniformGridRecipe
    extends MediumRecipe("uniformgrid", "a grid of densities", onlyV4)
    with HasScale
    with HasGrid
    with HasBox:
  private val density = numbers("density", "float[]", "nx by ny by nz densities, x first")
  private val temperature =
    numbers("temperature", "float[]", "of each cell, which glows", unit = "K")
  private val emittedScale =
    numbers("Lescale", "float[]", "factor of what each cell emits", shown = "1")
  private val emitted =
    color("Le", "emitted radiance", SpectrumRole.Emission, onlyV4, "W/(m² sr)", "none")(Rgb.Black)
  private val offset =
    float("temperatureoffset", "subtracted from temperatures", unit = "K")(0f)
  private val cutoff = float(
    "temperaturecutoff",
    "another name of `temperatureoffset`",
    unit = "K",
    shown = "temperatureoffset"
  )(0f)
  private val scaling = float("temperaturescale", "factor of temperatures")(1f)

  protected def make()(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    for
      map <- toUnit()
      grids <- samples("density", density())
      light <- glow()
    yield GridMedium(map, grids.head, absorption, scattering, light, phase())

  /** None after an error; else what glows, if anything does. */
  private def glow()(using site: Site): Option[Option[Glow]] =
    val (kelvins, factors) = (temperature(), emittedScale())
    val le = held(emitted(), "Le")
    val scale =
      if factors.isEmpty then Some(SampledGrid.One)
      else samples("Lescale", factors).map(_.head)
    if kelvins.nonEmpty && emitted.given_().isDefined then
      site.error("give a medium `Le` or `temperature`, not both")
      None
    else if kelvins.nonEmpty then
      for
        s <- scale
        t <- samples("temperature", kelvins)
      yield
        val below = offset.given_().getOrElse(cutoff())
        val hottest = (t.head.maximum - below) * scaling()
        Some(ThermalGlow(t.head, below, scaling(), Thermal.colors(hottest), s))
    else scale.map(s => Option.unless(le.isBlack)(ColoredGlow(le, s)))

object RgbGridRecipe
    extends MediumRecipe("rgbgrid", "a grid of coefficients", onlyV4)
    with HasGrid
    with HasBox:
  private val sigmaA =
    numbers("sigma_a", "rgb[]", "absorption of each cell", unit = PerUnit, shown = "1")
  private val sigmaS =
    numbers("sigma_s", "rgb[]", "scattering of each cell", unit = PerUnit, shown = "1")
  private val emitted =
    numbers("Le", "rgb[]", "emitted radiance of each cell", unit = "W/(m² sr)")
  private val scale = float("scale", "factor of the coefficients")(1f)
  private val emittedScale = float("Lescale", "factor of what is emitted", onlyV4)(1f)

  protected def make()(using site: Site): Option[Medium] =
    val (a, s, le) = (colors(sigmaA()), colors(sigmaS()), colors(emitted()))
    if a.isEmpty && s.isEmpty then
      site.error("an rgbgrid needs `sigma_a`, `sigma_s` or both")
      None
    else if a.isEmpty && le.nonEmpty then
      site.error("what emits must absorb: an rgbgrid with `Le` needs `sigma_a`")
      None
    else
      // As pbrt-v4 has it, this light is not scaled to the luminance that the colours say
      val brightness = emittedScale() * Thermal.LuminousIntegral
      val light = if brightness > 0f then le.map(_ * brightness) else Array.emptyFloatArray
      for
        map <- toUnit()
        absorption <- grid("sigma_a", a)
        scattering <- grid("sigma_s", s)
        glow <- grid("Le", light)
        size <- absorption.orElse(scattering)
      yield ColorGridMedium(
        map,
        size.r,
        absorption,
        scattering,
        constant = 1f,
        Math.max(0f, scale()),
        glow,
        phase()
      )

  private def colors(values: Array[Float])(using site: Site): Array[Float] =
    values.grouped(3).flatMap { v =>
      if v.length < 3 then v
      else
        val c = site.resources.basis.fromSrgb(Rgb(v(0), v(1), v(2)))
        Array(c.r, c.g, c.b)
    }.toArray

  /** None after an error; else the grid, if there is one. */
  private def grid(name: String, values: Array[Float])(using Site): Option[Option[ColorGrid]] =
    if values.isEmpty then Some(None)
    else samples(name, values, channels = 3).map(g => Some(ColorGrid(g(0), g(1), g(2))))

object CloudRecipe
    extends MediumRecipe("cloud", "a cloud of noise", onlyV4)
    with HasCoefficients
    with HasBox:
  private val density = float("density", "factor of the density")(1f)
  private val wispiness = float("wispiness", "how much the cloud frays")(1f)
  private val frequency = float("frequency", "of the noise")(5f)

  protected def make()(using site: Site): Option[Medium] =
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

object NanoVdbRecipe
    extends MediumRecipe("nanovdb", "densities from a NanoVDB file", onlyV4)
    with HasScale:
  override def pending: Option[String] =
    Some("there is no reader of NanoVDB files for the JVM; the medium is left out")
  declare(
    string("filename", "a .nvdb file", shown = "none")(""),
    string("gridname", "the grid of densities")("density"),
    string("temperaturename", "the grid of temperatures")("temperature"),
    float("Lescale", "factor of what is emitted", onlyV4)(1f),
    float("temperatureoffset", "subtracted from temperatures", unit = "K")(0f),
    float(
      "temperaturecutoff",
      "another name of `temperatureoffset`",
      unit = "K",
      shown = "temperatureoffset"
    )(0f),
    float("temperaturescale", "factor of temperatures")(1f)
  )
  protected def make()(using Site): Option[Medium] = None

/** How pbrt-v4's media glow by their temperature. */
private[build] object Thermal:

  /** ∫ ȳ(λ) dλ in nm, of the CIE 1931 observer: what light is brighter by that pbrt-v4 does not
    * divide by it.
    */
  val LuminousIntegral = 106.856895f

  /** Colours of black bodies, in a basis, whose spectra have a maximum of 1. */
  def colors(hottest: Float)(using site: Site): ThermalColors =
    ThermalColors(
      hottest,
      kelvin =>
        val c = Colorimetry.rgb(Spectrum.blackbody(kelvin)(_), White.EqualEnergy)
        site.resources.basis.fromSrgb(c * LuminousIntegral): Rgb
    )
