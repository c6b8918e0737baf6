package candela.convert

import candela.diagnostics.{Code, Problem}
import candela.color.Rgb
import candela.image.ImageFiles
import candela.lights.{EqualAreaMap, SkyModel, SunAndSky}
import candela.math.*
import candela.scenefile.{Declaration, Dialect, LightDescription, Param, SceneDescription}

/** Replaces the clear sky of Mitsuba's scenes and its sun by environment maps. */
private[convert] object SunskyLights:

  /** @param files where maps are written */
  def converted(scene: SceneDescription, files: SideFiles): Converted =
    val problems = Vector.newBuilder[Problem]
    val lights = scene.lights.flatMap: l =>
      if l.light.name != "sunsky" then Vector(l)
      else
        if !l.light.param("sunscale").exists(_.floats.contains(0f)) then
          problems += Problem.warning(
            Code.Inexpressible,
            l.light.pos,
            "the sun becomes an image, whose pixels blur its edge by 0.1 degrees"
          )
        inTwo(l, files)
    Converted(scene.copy(lights = lights), problems.result())

  private def inTwo(l: LightDescription, files: SideFiles): Vector[LightDescription] =
    val d = l.light
    def numbers(name: String) = d.param(name).map(_.floats)
    def number(name: String, default: Float) =
      numbers(name).flatMap(_.headOption).getOrElse(default)
    val ground = numbers("albedo") match
      case Some(Array(r, g, b)) => Rgb(r, g, b)
      case _ => Rgb.gray(0.3f)
    val toSun = numbers("sun") match
      case Some(Array(x, y, z)) => Vec3(x, y, z).normalized
      case _ => Vec3.Z
    val (sky, sun) = (number("skyscale", 1f), number("sunscale", 1f))
    if toSun.z < 0f then Vector.empty
    else
      val model =
        SkyModel(number("turbidity", 3f), ground, Math.asin(toSun.z.toDouble).toFloat)
      def light(name: String, params: Param*) =
        l.copy(light =
          Declaration(
            "LightSource", name, params.toVector, d.pos, d.folder.at(files.folder),
            dialect = Some(Dialect.V4)
          )
        )
      val map = Option.when(sky > 0f):
        val picture = SunAndSky.picture(model, toSun, Side, Side, EqualAreaMap, SamplesAcross)
        val file = files.add("sky", "exr", ImageFiles.exr(picture))
        val scale = Option.when(sky != 1f)(Param.float("scale", d.pos, sky))
        light("infinite", Param.string("filename", d.pos, file) +: scale.toSeq*)
      val irradiance = numbers("sunirradiance") match
        case Some(Array(r, g, b)) => Rgb(r, g, b)
        case _ => model.sunIrradiance
      val c = (irradiance * sun).map(Math.max(0f, _))
      val disk = Option.when(c.max > 0f):
        val (picture, scale) = SunImage(toSun, number("sunaperture", 0.5358f), c)
        val file = files.add("sun", "exr", ImageFiles.exr(picture))
        light(
          "infinite",
          Param.string("filename", d.pos, file),
          Param.float("scale", d.pos, scale)
        )
      map.toVector ++ disk

  /** Pixels along each side of a map, and parts of each pixel that are averaged. */
  private val Side = 1024
  private val SamplesAcross = 2
