package candela.build.textures

import candela.build.recipe.*
import candela.color.Rgb
import candela.math.Vec3
import candela.textures.*

/** All versions of pbrt put `inside` outside the dots, and `outside` inside. */
object FloatDotsRecipe extends MappedRecipe[FloatTexture]("dots", "round dots here and there"):
  private val inside = floatTexture("inside", "around the dots, as pbrt has it")(1f)
  private val outside = floatTexture("outside", "in the dots, as pbrt has it")(0f)
  protected def make()(using Site): FloatTexture = DotsFloat(mapped(), outside(), inside())

object RgbDotsRecipe extends MappedRecipe[RgbTexture]("dots", "round dots here and there"):
  private val inside = rgbTexture("inside", "around the dots, as pbrt has it")(Rgb.White)
  private val outside = rgbTexture("outside", "in the dots, as pbrt has it")(Rgb.Black)
  protected def make()(using Site): RgbTexture = DotsRgb(mapped(), outside(), inside())

object RgbUvRecipe
    extends MappedRecipe[RgbTexture]("uv", "the coordinates, as red and green", untilV3):
  protected def make()(using Site): RgbTexture = UvColor(mapped())

abstract class DirectionMixRecipe[A]
    extends Recipe[A]("directionmix", "blends by the surface's direction", onlyV4):
  private val direction = vector("dir", "where `tex1` is seen, as is −dir")(Vec3.Y)
  protected def axis()(using site: Site): Vec3 = site.toWorld.vector(direction()).normalized

object FloatDirectionMixRecipe extends DirectionMixRecipe[FloatTexture]:
  private val tex1 = floatTexture("tex1", "of surfaces across `dir`")(0f)
  private val tex2 = floatTexture("tex2", "of surfaces along `dir`")(1f)
  protected def make()(using Site): FloatTexture = DirectionMixFloat(tex1(), tex2(), axis())

object RgbDirectionMixRecipe extends DirectionMixRecipe[RgbTexture]:
  private val tex1 = rgbTexture("tex1", "of surfaces across `dir`")(Rgb.Black)
  private val tex2 = rgbTexture("tex2", "of surfaces along `dir`")(Rgb.White)
  protected def make()(using Site): RgbTexture = DirectionMixRgb(tex1(), tex2(), axis())
