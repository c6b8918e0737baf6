package candela.build.materials

import candela.bsdf.{DisneyMaterial, DisneyParameters, Material}
import candela.build.recipe.*
import candela.color.Rgb

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
