package candela.build

import candela.color.Rgb
import candela.scenefile.TextureDescription
import candela.textures.*

/** Recipes of textures: numbers and colours over a surface. */
object Textures:
  private val pending =
    Vector("dots", "fbm", "wrinkled", "windy", "marble", "uv", "ptex", "directionmix")
      .map(_ -> "0.5 is used all over")
      .toMap

  val floats: Recipes[FloatTexture] = Recipes(
    "float texture",
    Vector(FloatConstant, FloatScale, FloatMix, FloatChecks, FloatBilerp, FloatMap),
    pending
  )

  val colors: Recipes[RgbTexture] = Recipes(
    "spectrum texture",
    Vector(RgbConstant, RgbScale, RgbMix, RgbChecks, RgbBilerp, RgbMap),
    pending
  )

  /** Makes a texture and gives it its name, for the statements that follow.
    *
    * @param site with the texture's own transform
    */
  def define(t: TextureDescription, site: Site): Unit =
    if t.valueType == "float" then
      val made = floats.build(site).getOrElse(ConstantFloat(0.5f))
      site.resources.define(t.name, made)
    else
      val made = colors.build(site).getOrElse(ConstantRgb(Rgb.gray(0.5f)))
      site.resources.define(t.name, made)
