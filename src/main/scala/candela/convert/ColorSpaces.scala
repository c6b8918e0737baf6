package candela.convert

import candela.diagnostics.{Code, Problem}
import scala.collection.mutable

import candela.color.{ColorSpace, Rgb}
import candela.scenefile.{Declaration, Param, ParamType, SceneDescription}

/** Removes v4's colour spaces: v2 and v3 know sRGB only. */
object ColorSpaces:

  /** The scene with all colours in sRGB; colours that sRGB lacks are clamped, with a warning. */
  def removed(scene: SceneDescription): Converted =
    val warnings = mutable.LinkedHashSet.empty[Problem]
    for film <- scene.film if film.colorSpace != Srgb do
      val message = s"v3 writes sRGB images, not ${film.colorSpace}"
      warnings += Problem.warning(Code.ShiftedColors, film.pos, message)
    val converted = Declarations.map(scene): d =>
      val params = d.params.map(p =>
        inSrgb(p, d, m => warnings += Problem.warning(Code.ShiftedColors, p.pos, m))
      )
      d.copy(params = params ++ defaultWhite(d), colorSpace = Srgb)
    Converted(converted, warnings.toVector)

  private val Srgb = ColorSpace.Srgb.name

  private val Lights = Set("LightSource", "AreaLightSource")

  /** The colour of a light that is given none: the white of its space, unless that is sRGB's. */
  private def defaultWhite(d: Declaration): Option[Param] =
    val name = if Intensities(d.name) then "I" else "L"
    val isGiven = !Lights(d.category) || Vector(name, "filename").exists(d.param(_).isDefined)
    val white = ColorSpace.named(d.colorSpace).getOrElse(ColorSpace.Srgb).light(Rgb.White)
    Option.when(!isGiven && (white - Rgb.White).largest > 1e-3f):
      Param(ParamType.Rgb, name, d.pos, d.pos, floats = Array(white.r, white.g, white.b))

  /** Lights by their intensity. */
  private val Intensities = Set("point", "spot")

  private def inSrgb(p: Param, d: Declaration, warn: String => Unit): Param =
    ColorSpace.named(d.colorSpaceOf(p)).filter(!_.isSrgb && p.paramType == ParamType.Rgb) match
      case None => p
      case Some(space) =>
        val isLight = Lights(d.category) || p.name == "Le"
        val colors = p.floats.grouped(3).filter(_.length == 3).map: v =>
          val c = Rgb(v(0), v(1), v(2))
          if isLight then space.emission(c) else space.reflectance(c)
        val srgbColors = colors.toVector
        if srgbColors.exists(c => c.r < 0f || c.g < 0f || c.b < 0f) then
          warn(s"`${p.name}` is outside the gamut of sRGB; clamping")
        p.withFloats(srgbColors.flatMap(c => Vector(c.r, c.g, c.b)).map(Math.max(0f, _)).toArray)
