package candela.build.materials

import candela.diagnostics.Code
import candela.bsdf.Material
import candela.bsdf.microfacet.{
  DielectricMaterial, DispersiveMaterial, Roughness, RoughnessModel, ThinDielectricMaterial
}
import candela.build.recipe.*
import candela.color.{Rgb, Upsampling, Wavelengths}
import candela.scenefile.Dialect
import candela.textures.{ConstantFloat, RgbTexture}

object GlassRecipe
    extends MaterialRecipe("glass", "dielectric interface, smooth or rough", untilV3):
  private val kr = rgbTexture("Kr", "scale of reflection")(Rgb.White)
  private val kt = rgbTexture("Kt", "scale of refraction")(Rgb.White)
  private val eta = floatTexture(
    "eta", "index of refraction", onlyV3, shown = "index", range = Indices.range
  )(1.5f)
  private val index = floatTexture("index", "index of refraction", range = Indices.range)(1.5f)
  private val u =
    floatTexture(
      "uroughness",
      "roughness along u; 0: smooth",
      onlyV3,
      range = Range.nonNegative
    )(0f)
  private val v =
    floatTexture(
      "vroughness",
      "roughness along v; 0: smooth",
      onlyV3,
      range = Range.nonNegative
    )(0f)
  private val remap =
    bool("remaproughness", "remap roughness from [0, 1] to microfacet alpha", onlyV3)(true)
  protected def create()(using site: Site): Material =
    if site.dialect == Dialect.V2 then DielectricMaterial.pbrt2Glass(kr(), kt(), index())
    else
      val model = if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
      val rough = Roughness(u(), v(), model, smoothAtZero = true)
      new DielectricMaterial(kr(), kt(), eta.given_().getOrElse(index()), rough)

/** Declares the colours of Mitsuba's glass. */
private[build] trait GlassTints extends Fields:
  private val kr =
    rgbTexture("reflectance", "scale of reflection", onlyMitsuba)(Rgb.White)
  private val kt =
    rgbTexture("transmittance", "scale of transmission", onlyMitsuba)(Rgb.White)

  protected final def tints()(using Site): (RgbTexture, RgbTexture) = (kr(), kt())

object DielectricRecipe
    extends RoughRecipe("dielectric", "dielectric interface, smooth or rough", onlyV4, 0f)
    with GlassTints:
  private val eta = spectrum("eta", "index of refraction", range = Indices.range)(Indices.glass)
  protected def create()(using Site): Material =
    val (kr, kt) = tints()
    val index = ConstantFloat(Indices.scalar(eta()))
    Indices.disperse(eta())(new DielectricMaterial(kr, kt, index, roughness()))

object ThinDielectricRecipe
    extends MaterialRecipe("thindielectric", "thin dielectric slab, such as a window pane", onlyV4)
    with GlassTints:
  private val eta = spectrum("eta", "index of refraction", range = Indices.range)(Indices.glass)
  protected def create()(using Site): Material =
    val (kr, kt) = tints()
    Indices.disperse(eta())(ThinDielectricMaterial(Indices.scalar(eta()), kr, kt).folded)

/** Indices of refraction given as numbers or spectra. */
private[build] object Indices:
  val glass: SpectralValue = SpectralValue.Color(Rgb.gray(1.5f))

  /** In pbrt-v4, 0 means 1. */
  def range(using dialect: Dialect): Range =
    val positive = Range.atLeast(0.01f).limited
    if dialect.base == Dialect.V4 then positive.including(0f) else positive

  def spectrum(v: SpectralValue): Float => Float = v match
    case SpectralValue.Wavelengths(s) => s(_)
    case SpectralValue.Color(c, space) => Upsampling.unbounded(c, space)

  /** Spectral reflectance of a colour; constant for a grey. */
  def reflectance(c: Rgb): Float => Float =
    val isGrey = (c - Rgb.gray(c.g)).map(Math.abs(_)).max <= 1e-5f * c.g
    if isGrey then _ => c.g else Upsampling.spectrum(c)

  /** `material`, made for the index [[scalar]]; dispersive if that depends on the wavelength and
    * wavelengths are rendered.
    */
  def disperse(v: SpectralValue)(material: Material)(using site: Site): Material =
    if !varies(v) then material
    else if site.resources.basis.isSpectral then DispersiveMaterial(material)
    else
      site.resources.counting.foreach(_.addDispersion())
      material

  private def varies(v: SpectralValue): Boolean = v match
    case SpectralValue.Wavelengths(s) => s.values.distinct.length > 1
    case SpectralValue.Color(c, _) => c.r != c.g || c.g != c.b

  /** The index at the hero wavelength; of three-number colours at the sodium line, for which
    * indices of glass are specified. 0 means 1, as in pbrt-v4.
    */
  def scalar(v: SpectralValue)(using site: Site): Float =
    val index = site.resources.basis match
      case wavelengths: Wavelengths => spectrum(v)(wavelengths.nm(0))
      case _ => atSodium(v)
    if index == 0f then 1f else index

  private def atSodium(v: SpectralValue)(using site: Site): Float =
    if varies(v) && !site.resources.mayBeSpectral then
      val name = site.declaration.name
      site.warn(
        Code.Unsupported,
        s"dispersion of \"$name\" needs spectral colour; using the index of refraction at 589 nm",
        Some("render with `--color spectral`")
      )
    v match
      case SpectralValue.Color(c, _) => c.average
      case SpectralValue.Wavelengths(s) => s(Sodium)

  /** The sodium line in nm. */
  private inline val Sodium = 589.3f
