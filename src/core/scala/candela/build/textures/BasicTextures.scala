package candela.build.textures

import candela.build.recipe.*
import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.Dialect
import candela.textures.*

object FloatConstantRecipe extends Recipe[FloatTexture]("constant", "constant value"):
  private val value = float("value", "value")(1f)
  protected def create()(using Site): FloatTexture = ConstantFloat(value())

object RgbConstantRecipe extends Recipe[RgbTexture]("constant", "constant value"):
  private val value = color("value", "colour", SpectrumRole.Reflectance)(Rgb.White)
  protected def create()(using Site): RgbTexture = ConstantRgb(value())

object FloatScaleRecipe extends Recipe[FloatTexture]("scale", "product of two textures"):
  private val tex1 = floatTexture("tex1", "first factor", untilV3)(1f)
  private val tex2 = floatTexture("tex2", "second factor", untilV3)(1f)
  private val tex = floatTexture("tex", "first factor", onlyV4)(1f)
  private val scale = floatTexture("scale", "second factor", onlyV4)(1f)
  protected def create()(using site: Site): FloatTexture =
    if site.dialect == Dialect.V4 then ScaledFloat.of(tex(), scale())
    else ScaledFloat.of(tex1(), tex2())

object RgbScaleRecipe extends Recipe[RgbTexture]("scale", "product of two textures"):
  private val tex1 = rgbTexture("tex1", "first factor", untilV3)(Rgb.White)
  private val tex2 = rgbTexture("tex2", "second factor", untilV3)(Rgb.White)
  private val tex = rgbTexture("tex", "colour", onlyV4)(Rgb.White)
  private val scale = floatTexture("scale", "scale of the colour", onlyV4)(1f)
  protected def create()(using site: Site): RgbTexture =
    if site.dialect == Dialect.V4 then ScaledRgb.of(tex(), scale())
    else ProductRgb.of(tex1(), tex2())

object FloatMixRecipe extends Recipe[FloatTexture]("mix", "blend of two textures"):
  private val tex1 = floatTexture("tex1", "value where `amount` is 0")(0f)
  private val tex2 = floatTexture("tex2", "value where `amount` is 1")(1f)
  private val amount = floatTexture("amount", "blend weight of `tex2`, 0 to 1")(0.5f)
  protected def create()(using Site): FloatTexture = MixFloat.of(tex1(), tex2(), amount())

object RgbMixRecipe extends Recipe[RgbTexture]("mix", "blend of two textures"):
  private val tex1 =
    rgbTexture("tex1", "value where `amount` is 0")(Rgb.Black)
  private val tex2 = rgbTexture("tex2", "value where `amount` is 1")(Rgb.White)
  private val amount = floatTexture("amount", "blend weight of `tex2`, 0 to 1")(0.5f)
  protected def create()(using Site): RgbTexture = MixRgb.of(tex1(), tex2(), amount())

abstract class DirectionMixRecipe[A]
    extends Recipe[A]("directionmix", "blend by the direction of the surface normal", onlyV4):
  private val direction = vector("dir", "direction (and its opposite) of `tex1`")(Vec3.Y)
  protected def axis()(using site: Site): Vec3 =
    if direction().isZero then site.error(Code.ParameterValue, "`dir` must not be zero")
    site.toWorld.vector(direction()).normalized

object FloatDirectionMixRecipe extends DirectionMixRecipe[FloatTexture]:
  private val tex1 = floatTexture("tex1", "value where the normal is along `dir`")(0f)
  private val tex2 = floatTexture("tex2", "value where the normal is across `dir`")(1f)
  protected def create()(using Site): FloatTexture = DirectionMixFloat(tex1(), tex2(), axis())

object RgbDirectionMixRecipe extends DirectionMixRecipe[RgbTexture]:
  private val tex1 = rgbTexture("tex1", "value where the normal is along `dir`")(Rgb.Black)
  private val tex2 = rgbTexture("tex2", "value where the normal is across `dir`")(Rgb.White)
  protected def create()(using Site): RgbTexture = DirectionMixRgb(tex1(), tex2(), axis())
