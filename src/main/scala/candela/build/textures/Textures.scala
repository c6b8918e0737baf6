package candela.build.textures

import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.TextureDescription
import candela.textures.*

/** Recipes of textures: numbers and colours over a surface. */
object Textures:
  val floats: Recipes[FloatTexture] = Recipes(
    "float texture",
    Vector(
      FloatConstantRecipe, FloatScaleRecipe, FloatMixRecipe, FloatDirectionMixRecipe,
      FloatBilerpRecipe, FloatCheckerboardRecipe, FloatDotsRecipe, FloatImageMapRecipe,
      FloatPtexRecipe, FloatFbmRecipe, FloatWrinkledRecipe, FloatWindyRecipe
    )
  )

  val colors: Recipes[RgbTexture] = Recipes(
    "spectrum texture",
    Vector(
      RgbConstantRecipe, RgbScaleRecipe, RgbMixRecipe, RgbDirectionMixRecipe, RgbBilerpRecipe,
      RgbCheckerboardRecipe, RgbDotsRecipe, RgbImageMapRecipe, RgbPtexRecipe, RgbFbmRecipe,
      RgbWrinkledRecipe, RgbWindyRecipe, RgbMarbleRecipe, RgbUvRecipe
    )
  )

  /** Makes a texture and gives it its name, for the statements that follow.
    *
    * @param site with the texture's own transform
    */
  def define(t: TextureDescription, site: Site): Unit =
    if t.valueType == "float" then
      val made = floats.build(site).getOrElse(StandIns.number)
      site.resources.define(t.name, made)
    else
      val made = colors.build(site).getOrElse(StandIns.color(site.resources.basis))
      site.resources.define(t.name, made)

/** Of textures that are not rendered yet. */
trait HalfInstead[A] extends Recipe[A]:
  override def pending: Option[String] = Some("0.5 is used all over")

trait HalfFloat extends HalfInstead[FloatTexture]:
  protected def make()(using Site): FloatTexture = ConstantFloat(0.5f)

trait HalfRgb extends HalfInstead[RgbTexture]:
  protected def make()(using Site): RgbTexture = ConstantRgb(Rgb.gray(0.5f))
