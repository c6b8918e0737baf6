package candela.build.textures

import candela.build.recipe.*
import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.Dialect
import candela.textures.*

object FloatConstantRecipe extends Recipe[FloatTexture]("constant", "the same everywhere"):
  private val value = float("value", "the number")(1f)
  protected def make()(using Site): FloatTexture = ConstantFloat(value())

object RgbConstantRecipe extends Recipe[RgbTexture]("constant", "the same everywhere"):
  private val value = color("value", "the colour", SpectrumRole.Reflectance)(Rgb.White)
  protected def make()(using Site): RgbTexture = ConstantRgb(value())

object FloatScaleRecipe extends Recipe[FloatTexture]("scale", "the product of two"):
  private val tex1 = floatTexture("tex1", "one factor", untilV3)(1f)
  private val tex2 = floatTexture("tex2", "the other", untilV3)(1f)
  private val tex = floatTexture("tex", "one factor", onlyV4)(1f)
  private val scale = floatTexture("scale", "the other", onlyV4)(1f)
  protected def make()(using site: Site): FloatTexture =
    if site.dialect == Dialect.V4 then ScaledFloat.of(tex(), scale())
    else ScaledFloat.of(tex1(), tex2())

object RgbScaleRecipe extends Recipe[RgbTexture]("scale", "the product of two"):
  private val tex1 = rgbTexture("tex1", "one factor", untilV3)(Rgb.White)
  private val tex2 = rgbTexture("tex2", "the other", untilV3)(Rgb.White)
  private val tex = rgbTexture("tex", "the colour", onlyV4)(Rgb.White)
  private val scale = floatTexture("scale", "its factor", onlyV4)(1f)
  protected def make()(using site: Site): RgbTexture =
    if site.dialect == Dialect.V4 then ScaledRgb.of(tex(), scale())
    else ProductRgb.of(tex1(), tex2())

object FloatMixRecipe extends Recipe[FloatTexture]("mix", "a blend of two"):
  private val tex1 = floatTexture("tex1", "where `amount` is 0")(0f)
  private val tex2 = floatTexture("tex2", "where `amount` is 1")(1f)
  private val amount = floatTexture("amount", "between the two, 0 to 1")(0.5f)
  protected def make()(using Site): FloatTexture = MixFloat.of(tex1(), tex2(), amount())

object RgbMixRecipe extends Recipe[RgbTexture]("mix", "a blend of two"):
  private val tex1 =
    rgbTexture("tex1", "where `amount` is 0")(Rgb.Black)
  private val tex2 = rgbTexture("tex2", "where `amount` is 1")(Rgb.White)
  private val amount = floatTexture("amount", "between the two, 0 to 1")(0.5f)
  protected def make()(using Site): RgbTexture = MixRgb.of(tex1(), tex2(), amount())

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
