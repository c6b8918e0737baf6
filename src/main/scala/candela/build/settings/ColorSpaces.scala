package candela.build.settings

import candela.build.recipe.*

/** The names that v4's `ColorSpace` knows. */
object ColorSpaces:
  val all: Recipes[Unit] = Recipes(
    "color space",
    Vector(
      ColorSpaceRecipe("srgb", "sRGB: primaries of ITU-R BT.709, white D65"),
      WideSpaceRecipe("dci-p3", "primaries of DCI P3, white D65"),
      WideSpaceRecipe("rec2020", "primaries of ITU-R BT.2020, white D65"),
      WideSpaceRecipe("aces2065-1", "primaries AP0 of SMPTE ST 2065-1, white near D60")
    )
  )

class ColorSpaceRecipe(name: String, meaning: String) extends Recipe[Unit](name, meaning, onlyV4):
  protected def make()(using Site): Unit = ()

final class WideSpaceRecipe(name: String, meaning: String) extends ColorSpaceRecipe(name, meaning):
  override def pending: Option[String] = Some("colours are taken as sRGB")
