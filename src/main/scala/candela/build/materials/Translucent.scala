package candela.build.materials

import candela.bsdf.{Material, TranslucentMaterial}
import candela.build.recipe.*
import candela.color.Rgb

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
