package candela.build.recipe

import candela.bsdf.{DiffuseMaterial, Material}
import candela.color.{ColorBasis, Rgb}
import candela.image.{Image, StoredImage}
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}

/** What takes the place of what is missing, where the user asked to keep going: magenta, which
  * nobody overlooks or takes for the scene's own.
  */
object StandIns:
  val Magenta: Rgb = Rgb(1f, 0f, 1f)

  val picture: StoredImage = Image(1, 1, Image.RgbNames, Array(Magenta.r, Magenta.g, Magenta.b))
  val number: FloatTexture = ConstantFloat(1f)
  def color(basis: ColorBasis): RgbTexture = ConstantRgb(basis.fromSrgb(Magenta))
  def material(basis: ColorBasis): Material = DiffuseMaterial(color(basis)).folded

  // The same in messages
  val Magentas = "magenta is used"
  val Ones = "1 is used all over"
  val MagentaSurface = "a magenta surface is used"
  val LeftOut = "it is left out"
  val Default = "the default is used"

  /** For a type that nobody knows. */
  def ofCategory(category: String): String = category match
    case "material" => MagentaSurface
    case "spectrum texture" => Magentas
    case "float texture" => Ones
    case "shape" | "light" | "area light" => LeftOut
    case _ => Default
