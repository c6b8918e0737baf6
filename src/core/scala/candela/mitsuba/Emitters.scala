package candela.mitsuba

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.Transform
import candela.scenefile.{Declaration, Dialect, GraphicsState, LightDescription, Param, ParamType}

import scala.collection.mutable

/** Translates emitters. */
final class Emitters(
    session: Session,
    colors: Colors,
    textures: Textures,
    skies: Skies,
    medium: Plugin => String
):

  /** Those of shapes, which may stand outside of them and have an id. */
  private val ofShapes = mutable.HashSet.empty[Plugin]

  private val besideShapes = Vector.newBuilder[LightDescription]

  /** Emitters of shapes that aren't area lights: they light the scene from their own places. */
  def ofNoSurface: Vector[LightDescription] = besideShapes.result()

  /** The area light of a shape. */
  def area(p: Plugin): Option[Declaration] =
    if Emitters.Placed(p.name) then besideShapes ++= apply(p)
    ofShapes += p
    p.name match
      case "area" => session.translate(p)(diffuse)
      case "directionalarea" =>
        val cause = "it radiates along the normals only, where no path from the camera meets it"
        session.warn(Code.Unsupported, p.pos, s"${p.description} is ignored: $cause")
        None
      case name if Plugins.unsupportedTypes("emitter").contains(name) =>
        Plugins.unsupported(p, "ignored", session)
        None
      case name if Emitters.Placed(name) => None
      case _ =>
        session.error(
          Code.Nesting,
          p.pos,
          s"a shape can't contain an ${p.description}; expected \"area\""
        )
        None

  private def diffuse(in: Properties): Option[Declaration] =
    in.ignore("sampling_weight")
    val params = colors.shade(in, "radiance", Rgb.White, Role.Emission) match
      case c: Shade.Constant => Some(colors.light("L", c, in.pos))
      case Shade.Textured(t) => spread(t)
    params.map(session.declare("AreaLightSource", "diffuse", in.pos, _))

  /** The lights of an emitter of its own. */
  def apply(p: Plugin): Vector[LightDescription] =
    if ofShapes(p) then Vector.empty
    else
      session.attempt(session.translate(p): in =>
        if isOldSky(p) then OldSkies(session, skies)(in) else lone(in).toVector)
        .getOrElse(Vector.empty)

  private def isOldSky(p: Plugin): Boolean =
    p.name == "sky" || p.name == "sun" || p.name == "sunsky" && p.isOld

  private def lone(in: Properties): Option[LightDescription] =
    in.ignore("sampling_weight")
    val mediumName = in.nested("medium").headOption.fold("")(medium)
    in.plugin.name match
      case "constant" =>
        val c = colors.uniform(in, "radiance", Rgb.White, Role.Emission)
        Some(light(in, "infinite", Transform.Identity, mediumName)(colors.light("L", c, in.pos)*))
      case "envmap" => environment(in)
      case "sunsky" | "timed_sunsky" =>
        val toWorld = in.transform("to_world")
        Some(LightDescription(skies(in, toWorld), GraphicsState.constant(toWorld), ""))
      case "point" =>
        val c = colors.uniform(in, "intensity", Rgb.White, Role.Emission)
        val toWorld = in.triple("position").fold(in.transform("to_world")): (x, y, z) =>
          Transform.translate(x, y, z)
        Some(light(in, "point", toWorld, mediumName)(colors.light("I", c, in.pos)*))
      case "spot" => spot(in, mediumName)
      case "directional" => Some(directional(in))
      case "projector" => projector(in, mediumName)
      case "area" =>
        session.warn(Code.Nesting, in.pos, "an emitter \"area\" outside a shape emits nothing")
        in.ignore("radiance")
        None
      case _ =>
        Plugins.unsupported(in.plugin, "ignored", session)
        in.ignore(in.plugin.properties.map(_.name)*)
        None

  private def light(
      in: Properties,
      name: String,
      toWorld: Transform,
      medium: String,
      dialect: Option[Dialect] = None
  )(params: Param*): LightDescription =
    val d = session.declare("LightSource", name, in.pos, params, dialect)
    LightDescription(d, GraphicsState.constant(toWorld), medium)

  /** pbrt's poles are ±z, Mitsuba's ±y, and pbrt's azimuth begins at x, Mitsuba's at −z. */
  private def environment(in: Properties): Option[LightDescription] =
    val axes = Transform.fromRows(Vector(0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, 0, 1)).get
    in.ignore("mis_compensation", "cache")
    in.warnUnsupported("8-bit images are decoded from sRGB", "gamma")
    val scale = in.number("scale", 1).toFloat
    for
      name <- in.text("filename").orElse:
        session.error(Code.MissingParameter, in.pos, "an envmap must have a `filename`")
        None
    yield session.file(name, in.posOf("filename"), Textures.UsingMagenta) match
      case Some(path) =>
        // v4's maps are equal-area, v3's are latitude and longitude, as Mitsuba's
        light(in, "infinite", in.transform("to_world") * axes, "", Some(Dialect.V3))(
          Param.string("mapname", in.posOf("filename"), session.named(path)),
          Textures.rgb("L", Rgb.gray(scale), in.pos)
        )
      case None =>
        light(in, "infinite", Transform.Identity, "")(
          Textures.rgb("L", Textures.Magenta * scale, in.pos)
        )

  private def spot(in: Properties, mediumName: String): Option[LightDescription] =
    val c = colors.uniform(in, "intensity", Rgb.White, Role.Emission)
    val cutoff = in.number("cutoff_angle", 20)
    val beam = in.number("beam_width", cutoff * 0.75)
    def lit(shade: Shade.Constant, slide: Seq[Param]) =
      val params = colors.light("I", shade, in.pos) ++ Vector(
        Param.float("coneangle", in.pos, cutoff.toFloat),
        Param.float("conedeltaangle", in.pos, (cutoff - beam).toFloat)
      )
      Some(light(in, "spot", in.transform("to_world"), mediumName)((params ++ slide)*))
    colors.shade(in, "texture", Rgb.White, Role.Reflectance) match
      case Shade.Constant(tint, _) =>
        lit(if tint == Rgb.White then c else Shade.Constant(c.c * tint), Vector.empty)
      case Shade.Textured(t) =>
        picture(t).flatMap:
          case Right(params) => lit(c, slides(params))
          case Left(color) => lit(Shade.Constant(c.c * color), Vector.empty)

  private def slides(params: Seq[Param]): Seq[Param] =
    params.map(p => if p.name == "filename" then p.renamed("mapname") else p)

  private def directional(in: Properties): LightDescription =
    val c = colors.uniform(in, "irradiance", Rgb.White, Role.Emission)
    val (x, y, z) = in.triple("direction", (0, 0, 1))
    val endpoints = Seq("from" -> Array(0f, 0f, 0f), "to" -> Array(x.toFloat, y.toFloat, z.toFloat))
    light(in, "distant", in.transform("to_world"), "")(
      (colors.light("L", c, in.pos) ++
        endpoints.map((name, p) => Param.floats(ParamType.Point3, name, in.pos, p)))*
    )

  /** Irradiance of the plane at distance 1, by an image or a colour; the intensity of pbrt-v3's
    * projection is a π-th of it, without a cosine.
    */
  private def projector(in: Properties, mediumName: String): Option[LightDescription] =
    val scale = Rgb.gray((in.number("scale", 1) * Math.PI).toFloat)
    def lit(params: Param*) =
      // The width's, as of a square; what shows the image knows its height
      val fov = Param.float("fov", in.posOf("fov"), FieldOfView.shorter(in, 1).toFloat)
      val upright = in.transform("to_world") * Transform.scale(-1, -1, 1).get
      light(in, "projection", upright, mediumName, Some(Dialect.V3))((params :+ fov)*)
    colors.shade(in, "irradiance", Rgb.White, Role.Emission) match
      case Shade.Constant(c, _) =>
        colors.warnOfNegative(c * scale, in.pos)
        Some(lit(Textures.rgb("I", c * scale, in.pos)))
      case Shade.Textured(t) =>
        for axis <- in.text("fov_axis") if axis != "x" do
          session.warn(
            Code.CorrectedValue,
            in.posOf("fov_axis"),
            "a projector with an image supports only the axis x; using x"
          )
        picture(t).map:
          case Right(params) => lit((Textures.rgb("I", scale, in.pos) +: slides(params))*)
          case Left(color) => lit(Textures.rgb("I", color * scale, in.pos))

  /** A bitmap that emits, over u and v. */
  private def spread(p: Plugin): Option[Seq[Param]] =
    picture(
      p,
      in =>
        val filter = in.word("filter_type", "bilinear", "bilinear", "nearest")
        val wrap = in.word("wrap_mode", "repeat", "repeat", "mirror", "clamp")
        val mapping = textures.imageMapping(in)
        val uvMapping = Option.when(mapping != Textures.Upright):
          Param.floats(ParamType.Float, "imageuv", in.posOf("to_uv"), mapping.toArray)
        Seq(
          Param.string("wrap", in.posOf("wrap_mode"), wrap),
          Param
            .string(
              "filter",
              in.posOf("filter_type"),
              if filter == "nearest" then "point" else filter
            )
        ) ++ uvMapping
    ).map(_.fold(color => Seq(Textures.rgb("L", color, p.pos)), identity))

  /** The file of a bitmap that emits, or the colour in its place if there is no such file.
    *
    * @param extra further parameters of the texture
    */
  private def picture(
      p: Plugin,
      extra: Properties => Seq[Param] = plainParams
  ): Option[Either[Rgb, Seq[Param]]] =
    if p.name != "bitmap" then
      session.warn(Code.Unsupported, p.pos, s"${p.description} can't emit here; using nothing")
      None
    else
      session.translate(p): in =>
        in.ignore("format", "accel")
        val extraParams = extra(in)
        val isRaw = in.flag("raw", false)
        val at = in.posOf("filename")
        in.text("filename").map: name =>
          session.file(name, at, Textures.UsingMagenta).toRight(Textures.Magenta).map: path =>
            val file = Param.string("filename", at, session.named(path))
            Vector(file, Param.bool("raw", in.posOf("raw"), isRaw)) ++ extraParams

  private def plainParams(in: Properties): Seq[Param] =
    in.ignore("filter_type", "wrap_mode")
    in.warnUnsupported("ignored", "to_uv")
    Seq.empty

private[mitsuba] object Emitters:
  /** Types of which Mitsuba takes one. */
  val Surroundings: Set[String] = Set("constant", "envmap", "sunsky", "timed_sunsky")

  /** Types with a place or a direction of their own, which shapes may contain. */
  private val Placed = Set("directional", "point", "projector", "spot")
