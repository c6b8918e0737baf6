package candela.build.materials

import candela.bsdf.Material
import candela.bsdf.composite.{DisneyMaterial, DisneyParameters, PlasticMaterial, UberMaterial}
import candela.bsdf.microfacet.{Roughness, RoughnessModel, SubstrateMaterial}
import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.Dialect

object PlasticRecipe
    extends RoughRecipe("plastic", "diffuse with a glossy coat", untilV3, 0.1f, across = Set.empty):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.25f))
  private val ks = rgbTexture("Ks", "factor of the gloss")(Rgb.gray(0.25f))
  protected def make()(using site: Site): Material =
    PlasticMaterial(kd(), ks(), roughness(), edition(site.dialect))

object UberRecipe extends RoughRecipe(
      "uber",
      "diffuse, gloss, mirror and glass in one, with opacity",
      untilV3,
      0.1f
    ):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.25f))
  private val ks = rgbTexture("Ks", "factor of the gloss")(Rgb.gray(0.25f))
  private val kr = rgbTexture("Kr", "factor of mirror reflection")(Rgb.Black)
  private val kt = rgbTexture("Kt", "factor of refraction")(Rgb.Black)
  private val opacity = rgbTexture("opacity", "what does not pass straight through")(Rgb.White)
  private val eta = floatTexture("eta", "index of refraction", onlyV3, shown = "index")(1.5f)
  private val index = floatTexture("index", "index of refraction")(1.5f)
  protected def make()(using site: Site): Material =
    val n = eta.given_().getOrElse(index())
    UberMaterial(kd(), ks(), kr(), kt(), opacity(), n, roughness(), edition(site.dialect))

object SubstrateRecipe extends MaterialRecipe(
      "substrate",
      "diffuse under a glossy coat, by Ashikhmin and Shirley",
      untilV3
    ):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f))
  private val ks = rgbTexture("Ks", "gloss at normal incidence")(Rgb.gray(0.5f))
  private val u = floatTexture("uroughness", "along u")(0.1f)
  private val v = floatTexture("vroughness", "along v")(0.1f)
  private val remap = bool("remaproughness", "is roughness 0 to 1, or alpha?", onlyV3)(true)
  protected def make()(using site: Site): Material =
    val model =
      if site.dialect == Dialect.V2 then RoughnessModel.AnisotropicExponents
      else if remap() then RoughnessModel.PolynomialAlpha
      else RoughnessModel.BoundedAlpha
    SubstrateMaterial(kd(), ks(), Roughness(u(), v(), model))

object DisneyRecipe
    extends MaterialRecipe("disney", "the material of Burley 2012 and 2015", onlyV3):
  private val color = rgbTexture("color", "of the surface")(Rgb.gray(0.5f))
  private val metallic = floatTexture("metallic", "0: dielectric, 1: metal")(0f)
  private val eta = floatTexture("eta", "index of refraction")(1.5f)
  private val roughness = floatTexture("roughness", "of the surface")(0.5f)
  private val tint = floatTexture("speculartint", "highlights white, or of the surface's hue")(0f)
  private val anisotropic = floatTexture("anisotropic", "how much highlights are stretched")(0f)
  private val sheen = floatTexture("sheen", "of cloth, at grazing angles")(0f)
  private val sheenTint = floatTexture("sheentint", "sheen white, or of the surface's hue")(0.5f)
  private val clearcoat = floatTexture("clearcoat", "a second, thin gloss")(0f)
  private val coatGloss = floatTexture("clearcoatgloss", "how sharp that is")(1f)
  private val transmission = floatTexture("spectrans", "how much is refracted")(0f)
  private val distance =
    rgbTexture("scatterdistance", "mean free path below the surface", unit = "scene units")(
      Rgb.Black
    )
  private val thin = bool("thin", "is it a thin sheet?")(false)
  private val flatness = floatTexture("flatness", "of a thin sheet: how flat it looks")(0f)
  private val diffTrans =
    floatTexture("difftrans", "of a thin sheet: transmitted diffuse light, 0 to 2")(1f)

  protected def make()(using Site): Material =
    DisneyMaterial(
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
    )
