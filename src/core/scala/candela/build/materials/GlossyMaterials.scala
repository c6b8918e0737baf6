package candela.build.materials

import candela.bsdf.Material
import candela.bsdf.composite.{
  DisneyMaterial, DisneyParameters, Edition, PlasticMaterial, PrincipledMaterial,
  PrincipledThinMaterial, UberMaterial
}
import candela.bsdf.microfacet.{Roughness, RoughnessModel, SubstrateMaterial}
import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.Dialect
import candela.textures.{FloatTexture, RgbTexture}

object PlasticRecipe
    extends RoughRecipe(
      "plastic", "diffuse base with a glossy lobe", untilV3, 0.1f, across = Set.empty
    ):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.25f))
  private val ks = rgbTexture("Ks", "scale of the glossy lobe")(Rgb.gray(0.25f))
  protected def create()(using site: Site): Material =
    PlasticMaterial(kd(), ks(), roughness(), edition(site.dialect))

  /** The plastic of pbrt-v2. */
  def second(kd: RgbTexture, ks: RgbTexture, roughness: FloatTexture): Material =
    PlasticMaterial(
      kd,
      ks,
      Roughness(roughness, roughness, RoughnessModel.BlinnExponent),
      Edition.Second
    )

object UberRecipe extends RoughRecipe(
      "uber",
      "sum of diffuse, glossy, mirror and refractive lobes, with opacity",
      untilV3,
      0.1f
    ):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.25f))
  private val ks = rgbTexture("Ks", "scale of the glossy lobe")(Rgb.gray(0.25f))
  private val kr = rgbTexture("Kr", "scale of mirror reflection")(Rgb.Black)
  private val kt = rgbTexture("Kt", "scale of refraction")(Rgb.Black)
  private val opacity =
    rgbTexture("opacity", "fraction that does not pass through unscattered")(Rgb.White)
  private val eta = floatTexture(
    "eta", "index of refraction", onlyV3, shown = "index", range = Indices.range
  )(1.5f)
  private val index = floatTexture("index", "index of refraction", range = Indices.range)(1.5f)
  protected def create()(using site: Site): Material =
    val n = eta.given_().getOrElse(index())
    UberMaterial(kd(), ks(), kr(), kt(), opacity(), n, roughness(), edition(site.dialect))

object SubstrateRecipe extends MaterialRecipe(
      "substrate",
      "diffuse base under a glossy coating, by the Ashikhmin–Shirley model",
      untilV3
    ):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f))
  private val ks = rgbTexture("Ks", "glossy reflectance at normal incidence")(Rgb.gray(0.5f))
  private val u = floatTexture("uroughness", "roughness along u", range = Range.nonNegative)(0.1f)
  private val v = floatTexture("vroughness", "roughness along v", range = Range.nonNegative)(0.1f)
  private val remap =
    bool("remaproughness", "remap roughness from [0, 1] to microfacet alpha", onlyV3)(true)
  protected def create()(using site: Site): Material =
    val model =
      if site.dialect == Dialect.V2 then RoughnessModel.AnisotropicExponents
      else if remap() then RoughnessModel.PolynomialAlpha
      else RoughnessModel.BoundedAlpha
    SubstrateMaterial(kd(), ks(), Roughness(u(), v(), model))

/** Base of recipes of Burley's principled BSDF. */
abstract class DisneyFields(name: String, meaning: String, dialects: Set[Dialect])
    extends MaterialRecipe(name, meaning, dialects):
  private val color = rgbTexture("color", "base colour")(Rgb.gray(0.5f))
  private val metallic =
    floatTexture("metallic", "metallic weight; 0: dielectric, 1: conductor")(0f)
  private val eta = floatTexture("eta", "index of refraction", range = Indices.range)(1.5f)
  private val roughness =
    floatTexture("roughness", "surface roughness", range = Range.nonNegative)(0.5f)
  private val tint =
    floatTexture("speculartint", "tint of the specular lobe; 0: white, 1: hue of the surface")(0f)
  private val anisotropic = floatTexture("anisotropic", "anisotropy of the specular lobe")(0f)
  private val sheen = floatTexture("sheen", "strength of grazing cloth reflection")(0f)
  private val sheenTint =
    floatTexture("sheentint", "tint of the sheen; 0: white, 1: hue of the surface")(0.5f)
  private val clearcoat = floatTexture("clearcoat", "strength of the clear coat")(0f)
  private val coatGloss = floatTexture("clearcoatgloss", "gloss of the clear coat")(1f)
  private val transmission = floatTexture("spectrans", "strength of specular transmission")(0f)
  private val distance =
    rgbTexture("scatterdistance", "mean free path inside", unit = "scene units")(
      Rgb.Black
    )
  private val thin = bool("thin", "treat the surface as a thin sheet")(false)
  private val flatness = floatTexture("flatness", "flatness of a thin sheet")(0f)
  private val diffTrans =
    floatTexture("difftrans", "diffuse transmission of a thin sheet, 0 to 2")(1f)

  protected final def parameters()(using Site): DisneyParameters =
    DisneyParameters(
      color(),
      metallic(),
      eta(),
      roughness(),
      tint(),
      anisotropic(),
      sheen(),
      sheenTint(),
      clearcoat(),
      coatGloss(),
      transmission(),
      thin(),
      flatness(),
      diffTrans(),
      distance()
    )

object DisneyRecipe
    extends DisneyFields("disney", "principled BSDF of Burley 2012 and 2015", onlyV3):
  protected def create()(using Site): Material = DisneyMaterial(parameters())

object PrincipledRecipe
    extends DisneyFields("principled", "Mitsuba's edition of Burley's BSDF", onlyMitsuba):
  protected def create()(using Site): Material =
    val p = parameters()
    if p.isThin then PrincipledThinMaterial(p) else PrincipledMaterial(p)
