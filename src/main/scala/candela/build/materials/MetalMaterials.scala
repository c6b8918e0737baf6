package candela.build

import candela.bsdf.{
  ConductorReflectance, Fresnel, Material, MaterialFactory as Make, ReflectanceCurve,
  StrongConductorReflectance, TabulatedReflectance
}
import candela.color.{Colorimetry, Rgb}
import candela.scenefile.Dialect

/** Copper, where no metal is named. */
private[build] def copper(quantity: String): SpectralValue =
  SpectralValue.Wavelengths(Colorimetry.named(s"metal-Cu-$quantity").get)

object Mirror extends MaterialRecipe("mirror", "a perfect mirror", untilV3):
  private val kr = rgbTexture("Kr", "reflectance")(Rgb.gray(0.9f))
  protected def make()(using Site): Material = Make.mirror(kr())

object Metal extends RoughRecipe(
      "metal",
      "a conductor, by its index of refraction and absorption",
      untilV3,
      0.01f
    ):
  private val eta =
    spectrum(
      "eta",
      "index of refraction",
      shown = "of copper",
      typeName = "spectrum texture"
    )(copper("eta"))
  private val k =
    spectrum(
      "k",
      "absorption coefficient",
      shown = "of copper",
      typeName = "spectrum texture"
    )(copper("k"))
  protected def make()(using site: Site): Material =
    def rgb(v: SpectralValue): Rgb = v match
      case SpectralValue.Color(c) => c
      case SpectralValue.Wavelengths(s) =>
        Spectra.toRgb(s, SpectrumRole.Reflectance, site.dialect)
    val (n, a) = (rgb(eta()), rgb(k()))
    // pbrt-v2 has the approximation for strongly absorbing metals
    val curve =
      if site.dialect == Dialect.V2 then StrongConductorReflectance(n, a)
      else ConductorReflectance(n, a)
    Make.conductor(curve, roughness())

object Conductor extends RoughRecipe("conductor", "a metal, smooth or rough", onlyV4, 0f):
  private val eta =
    spectrum(
      "eta",
      "index of refraction",
      shown = "of copper",
      typeName = "spectrum texture"
    )(copper("eta"))
  private val k =
    spectrum(
      "k",
      "absorption coefficient",
      shown = "of copper",
      typeName = "spectrum texture"
    )(copper("k"))
  private val reflectance =
    rgbTexture(
      "reflectance",
      "at normal incidence, instead of eta and k",
      shown = "none"
    )(Rgb.White)
  protected def make()(using site: Site): Material =
    reflectance.given_() match
      case Some(r) => Make.conductor(r, roughness())
      case None =>
        val curve = reflectanceOf(Indices.spectrum(eta()), Indices.spectrum(k()))
        Make.conductor(curve, roughness())

  /** Fresnel's equations by wavelength, seen under white light, for each angle. */
  private def reflectanceOf(eta: Float => Float, k: Float => Float)(using
      site: Site
  ): ReflectanceCurve =
    TabulatedReflectance.of(128): cosTheta =>
      val reflected = Colorimetry.rgb(
        nm => Fresnel.conductor(cosTheta, eta(nm), k(nm)),
        Colorimetry.White.D65
      )
      site.resources.basis.fromSrgb(reflected)

object ShinyMetal extends RoughRecipe(
      "shinymetal",
      "a metal by its colours",
      onlyV2,
      0.1f,
      across = Set.empty
    ):
  private val kr = rgbTexture("Kr", "mirror reflectance at normal incidence")(Rgb.White)
  private val ks = rgbTexture("Ks", "glossy reflectance at normal incidence")(Rgb.White)
  protected def make()(using Site): Material = Make.shinyMetal(ks(), kr(), roughness())
