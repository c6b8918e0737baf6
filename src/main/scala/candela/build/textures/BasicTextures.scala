package candela.build.textures

import candela.build.recipe.*
import candela.color.Rgb
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
