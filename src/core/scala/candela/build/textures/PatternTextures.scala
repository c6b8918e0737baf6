package candela.build.textures

import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.Dialect
import candela.textures.*

abstract class CheckerboardRecipe[A]
    extends MappedRecipe[A]("checkerboard", "checkerboard of two textures"):
  private val dimension =
    integer("dimension", "3 for a solid checkerboard", range = Range(2f, 3f).deferred)(2)
  private val aamode =
    oneOf("aamode", "antialiasing of edges", Seq("closedform", "none"), untilV3)("closedform")

  /** pbrt-v2 and v3 filter squares only, v4 also cubes. */
  protected def checks()(using site: Site): Checks =
    val isSolid = dimension() == 3
    val filter =
      if !site.rules.filters then CheckFilter.Point
      else if site.dialect == Dialect.V4 then CheckFilter.Triangle
      else if isSolid || aamode() == "none" then CheckFilter.Point
      else CheckFilter.Box
    if filter != CheckFilter.Point then site.resources.askForFootprints("checkerboards")
    if isSolid then Cubes(Solid.repeating(2), filter) else Squares(mapped(2), filter)

object FloatCheckerboardRecipe extends CheckerboardRecipe[FloatTexture]:
  private val tex1 = floatTexture("tex1", "value of even squares")(1f)
  private val tex2 = floatTexture("tex2", "value of odd squares")(0f)
  protected def create()(using Site): FloatTexture = CheckerboardFloat(checks(), tex1(), tex2())

object RgbCheckerboardRecipe extends CheckerboardRecipe[RgbTexture]:
  private val tex1 = rgbTexture("tex1", "value of even squares")(Rgb.White)
  private val tex2 = rgbTexture("tex2", "value of odd squares")(Rgb.Black)
  protected def create()(using Site): RgbTexture = CheckerboardRgb(checks(), tex1(), tex2())

object FloatBilerpRecipe
    extends MappedRecipe[FloatTexture]("bilerp", "bilinear interpolation of four corner values"):
  private val corners = Vector("v00", "v01", "v10", "v11").zip(Vector(0f, 1f, 0f, 1f)).map:
    (n, d) =>
      float(n, s"value at the corner $n")(d)
  protected def create()(using Site): FloatTexture =
    BilerpFloat(mapped(0), corners(0)(), corners(1)(), corners(2)(), corners(3)())

object RgbBilerpRecipe
    extends MappedRecipe[RgbTexture]("bilerp", "bilinear interpolation of four corner values"):
  private val corners = Vector("v00", "v01", "v10", "v11").zip(Vector(0f, 1f, 0f, 1f)).map:
    (n, d) =>
      color(n, s"colour at the corner $n", SpectrumRole.Reflectance)(Rgb.gray(d))
  protected def create()(using Site): RgbTexture =
    BilerpRgb(mapped(0), corners(0)(), corners(1)(), corners(2)(), corners(3)())

/** All versions of pbrt use `inside` outside the dots and `outside` inside. */
object FloatDotsRecipe extends MappedRecipe[FloatTexture]("dots", "polka dots"):
  private val inside = floatTexture("inside", "value outside the dots, as in pbrt")(1f)
  private val outside = floatTexture("outside", "value inside the dots, as in pbrt")(0f)
  protected def create()(using Site): FloatTexture =
    DotsFloat(mapped(PerlinNoise.Period), outside(), inside())

object RgbDotsRecipe extends MappedRecipe[RgbTexture]("dots", "polka dots"):
  private val inside = rgbTexture("inside", "value outside the dots, as in pbrt")(Rgb.White)
  private val outside = rgbTexture("outside", "value inside the dots, as in pbrt")(Rgb.Black)
  protected def create()(using Site): RgbTexture =
    DotsRgb(mapped(PerlinNoise.Period), outside(), inside())

object RgbUvRecipe
    extends MappedRecipe[RgbTexture]("uv", "texture coordinates as red and green", untilV3):
  protected def create()(using Site): RgbTexture = UvColor(mapped(1))

abstract class LinesRecipe[A]
    extends MappedRecipe[A]("lines", "lines where s or t is an integer", onlyMitsuba):
  private val width = float("linewidth", "half the width of a line")(0.01f)
  protected def lines()(using Site): Lines = Lines(mapped(1), width())

object FloatLinesRecipe extends LinesRecipe[FloatTexture]:
  private val tex1 = floatTexture("tex1", "value between the lines")(0.2f)
  private val tex2 = floatTexture("tex2", "value of the lines")(0.4f)
  protected def create()(using Site): FloatTexture = LinesFloat(lines(), tex1(), tex2())

object RgbLinesRecipe extends LinesRecipe[RgbTexture]:
  private val tex1 = rgbTexture("tex1", "value between the lines")(Rgb.gray(0.2f))
  private val tex2 = rgbTexture("tex2", "value of the lines")(Rgb.gray(0.4f))
  protected def create()(using Site): RgbTexture = LinesRgb(lines(), tex1(), tex2())
