package candela.build

import candela.color.Rgb
import candela.textures.*

abstract class Checks[A] extends Mapped[A]("checkerboard", "squares of two in turn"):
  private val dimension = integer("dimension", "2, or 3 for cubes in space")(2)
  noMeaning("the pixel's samples smooth its edges")(
    string("aamode", "how edges are smoothed: closedform, none", untilV3)("closedform")
  )
  protected def isSolid()(using Site): Boolean = dimension() == 3

object FloatChecks extends Checks[FloatTexture]:
  private val tex1 = floatTexture("tex1", "of even squares")(1f)
  private val tex2 = floatTexture("tex2", "of odd squares")(0f)
  protected def make()(using Site): FloatTexture =
    if isSolid() then CubesFloat(Solid.mapping, tex1(), tex2())
    else CheckerboardFloat(mapped(), tex1(), tex2())

object RgbChecks extends Checks[RgbTexture]:
  private val tex1 = rgbTexture("tex1", "of even squares")(Rgb.White)
  private val tex2 = rgbTexture("tex2", "of odd squares")(Rgb.Black)
  protected def make()(using Site): RgbTexture =
    if isSolid() then CubesRgb(Solid.mapping, tex1(), tex2())
    else CheckerboardRgb(mapped(), tex1(), tex2())

object FloatBilerp extends Mapped[FloatTexture]("bilerp", "blends the values at four corners"):
  private val corners = Vector("v00", "v01", "v10", "v11").zip(Vector(0f, 1f, 0f, 1f)).map:
    (n, d) =>
      float(n, s"value at the corner $n")(d)
  protected def make()(using Site): FloatTexture =
    BilerpFloat(mapped(), corners(0)(), corners(1)(), corners(2)(), corners(3)())

object RgbBilerp extends Mapped[RgbTexture]("bilerp", "blends the values at four corners"):
  private val corners = Vector("v00", "v01", "v10", "v11").zip(Vector(0f, 1f, 0f, 1f)).map:
    (n, d) =>
      color(n, s"colour at the corner $n", SpectrumRole.Reflectance)(Rgb.gray(d))
  protected def make()(using Site): RgbTexture =
    BilerpRgb(mapped(), corners(0)(), corners(1)(), corners(2)(), corners(3)())
