package candela.build.materials

import candela.bsdf.{DiffuseMaterial, DiffuseTransmissionMaterial, Material, MatteMaterial}
import candela.bsdf.composite.TranslucentMaterial
import candela.build.recipe.*
import candela.color.Rgb

object MatteRecipe extends MaterialRecipe("matte", "diffuse, with Oren–Nayar's roughness", untilV3):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f))
  private val sigma = floatTexture("sigma", "Oren–Nayar's spread of facets, degrees")(0f)
  protected def make()(using Site): Material = MatteMaterial(kd(), sigma())

object DiffuseRecipe extends MaterialRecipe("diffuse", "scatters evenly to all sides", onlyV4):
  private val reflectance = rgbTexture("reflectance", "0 to 1")(Rgb.gray(0.5f))
  protected def make()(using Site): Material = DiffuseMaterial(reflectance())

object DiffuseTransmissionRecipe
    extends MaterialRecipe("diffusetransmission", "scatters evenly, on both sides", onlyV4):
  private val reflectance = rgbTexture("reflectance", "0 to 1")(Rgb.gray(0.25f))
  private val transmittance = rgbTexture("transmittance", "0 to 1")(Rgb.gray(0.25f))
  private val scale = float("scale", "factor of both")(1f)
  protected def make()(using Site): Material =
    DiffuseTransmissionMaterial(reflectance(), transmittance(), scale())

object TranslucentRecipe
    extends RoughRecipe(
      "translucent",
      "reflects and transmits, diffuse and glossy",
      untilV3,
      0.1f,
      across = Set.empty
    ):
  private val kd = rgbTexture("Kd", "diffuse part")(Rgb.gray(0.25f))
  private val ks = rgbTexture("Ks", "glossy part")(Rgb.gray(0.25f))
  private val reflect = rgbTexture("reflect", "factor of what is reflected")(Rgb.gray(0.5f))
  private val transmit = rgbTexture("transmit", "factor of what is transmitted")(Rgb.gray(0.5f))
  protected def make()(using site: Site): Material =
    TranslucentMaterial(kd(), ks(), reflect(), transmit(), roughness(), edition(site.dialect))
