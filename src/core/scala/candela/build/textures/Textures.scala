package candela.build.textures

import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.TextureDescription
import candela.textures.*

/** Recipes of float and spectrum textures. */
object Textures:
  val floats: Recipes[FloatTexture] = Recipes(
    "float texture",
    Vector(
      FloatConstantRecipe, FloatScaleRecipe, FloatMixRecipe, FloatDirectionMixRecipe,
      FloatBilerpRecipe, FloatCheckerboardRecipe, FloatDotsRecipe, FloatImageMapRecipe,
      FloatPtexRecipe, FloatFbmRecipe, FloatWrinkledRecipe, FloatWindyRecipe,
      FloatLinesRecipe, FloatGridRecipe, FloatVertexRecipe
    )
  )

  val colors: Recipes[RgbTexture] = Recipes(
    "spectrum texture",
    Vector(
      RgbConstantRecipe, RgbScaleRecipe, RgbMixRecipe, RgbDirectionMixRecipe, RgbBilerpRecipe,
      RgbCheckerboardRecipe, RgbDotsRecipe, RgbImageMapRecipe, RgbPtexRecipe, RgbFbmRecipe,
      RgbWrinkledRecipe, RgbWindyRecipe, RgbMarbleRecipe, RgbUvRecipe, RgbLinesRecipe,
      RgbGridRecipe,
      RgbVertexRecipe
    )
  )

  /** Whether a texture has numbers, or colours. */
  def kind(t: TextureDescription): String = if t.valueType == "float" then "float" else "spectrum"

  /** Builds a texture and registers its name for the statements that follow.
    *
    * @param site site with the texture's own transform
    */
  def define(t: TextureDescription, site: Site): Unit =
    if kind(t) == "float" then
      site.resources.defineFloat(t.name, site.declaration.pos, site.problems):
        floats.build(site).getOrElse(StandIns.number)
    else
      site.resources.defineRgb(t.name, site.declaration.pos, site.problems):
        colors.build(site).getOrElse(StandIns.color(site.resources.basis))

/** Recipes of unsupported textures, which fall back to 0.5. */
trait HalfInstead[A] extends Recipe[A]:
  override def substitute: Option[String] =
    Some("using the constant 0.5, since no library for the JVM reads Ptex")

trait HalfFloat extends HalfInstead[FloatTexture]:
  protected def create()(using Site): FloatTexture = ConstantFloat(0.5f)

trait HalfRgb extends HalfInstead[RgbTexture]:
  protected def create()(using Site): RgbTexture = ConstantRgb(Rgb.gray(0.5f))
