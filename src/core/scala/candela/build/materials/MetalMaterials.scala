package candela.build.materials

import candela.diagnostics.Code
import candela.bsdf.{Fresnel, Material, TabulatedReflectance}
import candela.bsdf.microfacet.{
  ConductorMaterial, IndexedMetal, MetalTexture, MirrorMaterial, ShinyMetalMaterial, TintedMetal,
  UniformMetal
}
import candela.build.recipe.*
import candela.color.{Colorimetry, NamedSpectra, Rgb}
import candela.math.*
import candela.scenefile.Dialect
import candela.textures.RgbTexture

/** Parameters of a conductor; the defaults are those of copper. */
private[build] final class MetalIndex(
    val eta: Field[SpectrumSource],
    val k: Field[SpectrumSource],
    val reflectance: Option[Field[RgbTexture]]
)

/** Declares and reads the parameters of conductors. */
private[build] trait MetalFields extends SpectrumFields:

  /** @param prefix prefix of the parameter names
    * @param tint   whether a reflectance at normal incidence is an alternative
    */
  protected final def metalIndex(prefix: String = "", tint: Boolean = false): MetalIndex =
    def copper(quantity: String) =
      SpectralValue.Wavelengths(NamedSpectra(s"metal-Cu-$quantity").get)
    def number(name: String, meaning: String) =
      spectrumTexture(s"$prefix$name", meaning, shown = "of copper")(copper(name))
    MetalIndex(
      number("eta", "index of refraction"),
      number("k", "absorption coefficient"),
      Option.when(tint):
        rgbTexture(
          "reflectance",
          "reflectance at normal incidence, instead of eta and k",
          shown = "none"
        )(
          Rgb.White
        )
    )

  /** A conductor of pbrt-v4, spectral unless its parameters are textured.
    *
    * @param outside index of refraction of the surrounding medium
    */
  protected final def metal(index: MetalIndex, outside: Float = 1f)(using
      site: Site
  ): MetalTexture =
    if site.rules.plainMetals && !site.resources.basis.isSpectral then
      // Mitsuba multiplies three numbers here, too
      def plain(source: SpectrumSource) = SpectrumSource.textured(source):
        case SpectralValue.Color(c, _) => c
        case other => site.resources.basis.ofReflectance(Indices.spectrum(other))
      IndexedMetal(plain(index.eta()), plain(index.k()), outside)
    else
      spectral(index, outside) match
        case Some(reflected) => uniform(reflected, site)
        case None =>
          def varying(source: SpectrumSource) = SpectrumSource.textured(source): value =>
            site.resources.basis.ofReflectance(Indices.spectrum(value))
          IndexedMetal(varying(index.eta()), varying(index.k()), outside)

  /** Makes conductors by their reflectance at normal incidence, its [[tintedSpectrum]], and their
    * sites.
    */
  protected final def tintedMetal(index: MetalIndex, outside: Float = 1f)(using
      site: Site
  ): (RgbTexture, Option[Float => Float => Float], Site) => MetalTexture =
    if index.eta.given_().isDefined || index.k.given_().isDefined then
      val names = s"`${index.eta.name}` and `${index.k.name}`"
      site.error(
        Code.ExclusiveParameters,
        s"`reflectance` and $names of \"${site.declaration.name}\" are mutually exclusive"
      )
    (reflectance, spectrum, site) =>
      spectrum.fold(TintedMetal(reflectance, outside))(uniform(_, site))

  private def uniform(reflected: Float => Float => Float, site: Site): MetalTexture =
    site.resources.counting.foreach(_.addReflectance(site.declaration, reflected(1f)))
    UniformMetal(TabulatedReflectance(128, Spectra.underWhite(reflected)(using site)))

  /** Reflectance by cosine and wavelength; None if it is textured. */
  protected final def spectral(index: MetalIndex, outside: Float)(using
      site: Site
  ): Option[Float => Float => Float] =
    (index.eta(), index.k()) match
      case (SpectrumSource.Uniform(eta), SpectrumSource.Uniform(k)) =>
        val (n, a) = (cached(Indices.spectrum(eta)), cached(Indices.spectrum(k)))
        Some(c => nm => Fresnel.conductor(c, n(nm) / outside, a(nm) / outside))
      case _ => None

  /** Likewise, of a conductor of this reflectance at normal incidence. */
  protected final def tintedSpectrum(color: RgbTexture, outside: Float)(using
      site: Site
  ): Option[Float => Float => Float] =
    for c <- color.constant yield
      val basis = site.resources.basis
      lazy val reflectance =
        if basis.isSpectral then basis.reflectance(c) else Indices.reflectance(basis.toSrgb(c))
      val absorption = cached: nm =>
        val r = clamp(reflectance(nm), 0f, 0.9999f)
        2f * sqrt(r) / sqrt(1f - r)
      cosTheta => nm => Fresnel.conductor(cosTheta, 1f / outside, absorption(nm) / outside)

  /** Evaluated once by wavelength where the reflectance has a colour at each of many cosines. */
  private def cached(s: Float => Float)(using site: Site): Float => Float =
    if site.resources.basis.isSpectral then s else Colorimetry.memoized(s)

object MirrorRecipe extends MaterialRecipe("mirror", "perfect specular mirror", untilV3):
  private val kr = rgbTexture("Kr", "reflectance")(Rgb.gray(0.9f))
  protected def create()(using Site): Material = MirrorMaterial(kr())

object MetalRecipe
    extends RoughRecipe(
      "metal",
      "conductor by its index of refraction and absorption",
      untilV3,
      0.01f
    )
    with MetalFields:
  private val index = metalIndex()
  protected def create()(using site: Site): Material =
    def rgb(v: SpectralValue): Rgb = Spectra.inBasis(v, SpectrumRole.Unbounded, site)
    val eta = SpectrumSource.textured(index.eta())(rgb)
    val k = SpectrumSource.textured(index.k())(rgb)
    // pbrt-v2 uses the approximation for strong absorption
    ConductorMaterial(IndexedMetal(eta, k, strong = site.dialect == Dialect.V2), roughness())

object ConductorRecipe
    extends RoughRecipe("conductor", "conductor, smooth or rough", onlyV4, 0f)
    with MetalFields
    with TintedRecipe:
  private val index = metalIndex(tint = true)
  private val scale = rgbTexture("scale", "scale of the reflectance", onlyMitsuba)(Rgb.White)
  protected val tint: Field[RgbTexture] = index.reflectance.get

  override protected def create()(using Site): Material =
    if tint.given_().isDefined then super.create()
    else ConductorMaterial(metal(index), roughness(), scale())

  protected def tinted()(using Site): (RgbTexture, Site) => Material =
    val (rough, scaled) = (roughness(), scale())
    val metal = tintedMetal(index)
    (reflectance, site) =>
      val spectrum = tintedSpectrum(reflectance, outside = 1f)
      ConductorMaterial(metal(reflectance, spectrum, site), rough, scaled)

object ShinyMetalRecipe extends RoughRecipe(
      "shinymetal",
      "conductor by its reflectances",
      onlyV2,
      0.1f,
      across = Set.empty
    ):
  private val kr = rgbTexture("Kr", "mirror reflectance at normal incidence")(Rgb.White)
  private val ks = rgbTexture("Ks", "glossy reflectance at normal incidence")(Rgb.White)
  protected def create()(using Site): Material = ShinyMetalMaterial(ks(), kr(), roughness())
