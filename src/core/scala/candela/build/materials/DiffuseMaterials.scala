package candela.build.materials

import candela.bsdf.{DiffuseMaterial, DiffuseTransmissionMaterial, Material, MatteMaterial}
import candela.bsdf.composite.TranslucentMaterial
import candela.build.recipe.*
import candela.color.Rgb
import candela.textures.RgbTexture

object MatteRecipe
    extends MaterialRecipe("matte", "diffuse reflection by the Oren–Nayar model", untilV3):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.5f))
  private val sigma =
    floatTexture(
      "sigma",
      "standard deviation of facet angles, degrees",
      range = Range(0f, 90f).limited
    )(0f)
  protected def create()(using Site): Material = MatteMaterial(kd(), sigma())

object DiffuseRecipe
    extends MaterialRecipe("diffuse", "Lambertian reflection", onlyV4)
    with TintedRecipe:
  protected val tint: Field[RgbTexture] =
    rgbTexture("reflectance", "diffuse reflectance, 0 to 1")(Rgb.gray(0.5f))
  protected def tinted()(using site: Site): (RgbTexture, Site) => Material =
    val gains = site.rules.gains
    (reflectance, _) => DiffuseMaterial(reflectance, gains)

object DiffuseTransmissionRecipe
    extends MaterialRecipe("diffusetransmission", "Lambertian reflection and transmission", onlyV4):
  private val reflectance =
    rgbTexture("reflectance", "diffuse reflectance, 0 to 1")(Rgb.gray(0.25f))
  private val transmittance =
    rgbTexture("transmittance", "diffuse transmittance, 0 to 1")(Rgb.gray(0.25f))
  private val scale = float("scale", "scale of reflectance and transmittance")(1f)
  protected def create()(using Site): Material =
    DiffuseTransmissionMaterial(reflectance(), transmittance(), scale())

object TranslucentRecipe
    extends RoughRecipe(
      "translucent",
      "diffuse and glossy reflection and transmission",
      untilV3,
      0.1f,
      across = Set.empty
    ):
  private val kd = rgbTexture("Kd", "diffuse reflectance")(Rgb.gray(0.25f))
  private val ks = rgbTexture("Ks", "glossy reflectance")(Rgb.gray(0.25f))
  private val reflect = rgbTexture("reflect", "scale of reflection")(Rgb.gray(0.5f))
  private val transmit = rgbTexture("transmit", "scale of transmission")(Rgb.gray(0.5f))
  protected def create()(using site: Site): Material =
    TranslucentMaterial(kd(), ks(), reflect(), transmit(), roughness(), edition(site.dialect))
