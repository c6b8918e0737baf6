package candela.mitsuba

import candela.diagnostics.{Code, SourcePos}
import candela.io.FileName
import candela.math.Transform
import candela.scenefile.{Declaration, GraphicsState, Param, SceneDescription}

import java.nio.file.Path

/** Translates sensors with their films, filters and samplers. */
final class Views(session: Session, media: Media, scene: Path):

  /** The scene as seen by a sensor. */
  def addSensor(p: Plugin, from: SceneDescription): SceneDescription =
    session.translate(p): in =>
      val (width, height, film) = in.nested("film").headOption match
        case Some(f) => session.translate(f)(filmOf)
        case None => filmOf(Properties(plain("film", "hdrfilm", in.at), session))
      val filter = in.nested("film").headOption
        .flatMap(f => Properties(f, session).nested("rfilter").headOption)
        .getOrElse(plain("rfilter", "gaussian", in.at))
      val sampler =
        in.nested("sampler").headOption.getOrElse(plain("sampler", "independent", in.at))
      in.ignore("srf")
      val toWorld = in.transform("to_world")
      val medium = in.nested("medium").headOption.fold("")(media(_))
      // Mitsuba's x points left, pbrt's right
      val toCamera = (toWorld * Transform.scale(-1, 1, 1).get).inverse
      from.copy(
        camera = Some(camera(in, width, height)),
        worldToCamera = GraphicsState.still(toCamera),
        cameraMedium = medium,
        film = Some(film),
        filter = Some(session.translate(filter)(filterOf)),
        sampler = Some(session.translate(sampler)(samplerOf))
      )

  private def plain(kind: String, name: String, at: SourcePos): Plugin =
    Plugin(kind, name, None, at, Vector.empty)

  private def camera(in: Properties, width: Int, height: Int): Declaration =
    val shutter = Seq("shutter_open" -> "shutteropen", "shutter_close" -> "shutterclose").flatMap:
      (name, ours) => in.number(name).map(x => Param.float(ours, in.atOf(name), x.toFloat))
    val clips = Seq("near_clip" -> "nearclip", "far_clip" -> "farclip").flatMap: (name, ours) =>
      in.number(name).map(x => Param.float(ours, in.atOf(name), x.toFloat))
    val always = shutter ++ clips
    val aspect = width.toDouble / height
    val dx = in.number("principal_point_offset_x", 0)
    val dy = in.number("principal_point_offset_y", 0)
    val (halfX, halfY) = if aspect >= 1 then (aspect, 1.0) else (1.0, 1 / aspect)
    def window(halfX: Double, halfY: Double) =
      val (cx, cy) = (2 * dx * halfX, -2 * dy * halfY)
      val sides = Seq(cx - halfX, cx + halfX, cy - halfY, cy + halfY).map(_.toFloat)
      Param.float("screenwindow", in.at, sides*)
    in.plugin.name match
      case "orthographic" =>
        session.declare("Camera", "orthographic", in.at, always :+ window(1, 1 / aspect))
      case name =>
        if name != "perspective" && name != "thinlens" then
          Plugins.unsupported(in.plugin, "using \"perspective\"", session)
          in.ignore(in.plugin.properties.map(_.name)*)
        val view =
          Seq(Param.float("fov", in.atOf("fov"), FieldOfView.shorter(in, aspect).toFloat)) ++
            Option.when(dx != 0 || dy != 0)(window(halfX, halfY))
        val focus = in.number("focus_distance")
        val lens =
          if name != "thinlens" then Nil
          else
            Seq(
              Param.float("lensradius", in.at, in.number("aperture_radius", 0).toFloat),
              Param.float(
                "focaldistance",
                in.at,
                focus.orElse(in.number("far_clip")).getOrElse(1e4).toFloat
              )
            )
        session.declare("Camera", "perspective", in.at, view ++ lens ++ always)

  /** Width and height in pixels, and the film. */
  private def filmOf(in: Properties): (Int, Int, Declaration) =
    if !Plugins.films.contains(in.plugin.name) then
      Plugins.unsupported(in.plugin, "using \"hdrfilm\"", session)
    val (width, height) = (in.integer("width", 768), in.integer("height", 576))
    if width < 1 || height < 1 then
      Values.fail(Code.TooLarge, in.at, s"a film can't have $width × $height pixels")
    in.nested("rfilter"): Unit
    in.ignore(
      "file_format", "banner", "compensate", "gamma",
      "tonemap_method", "attach_log", "exposure", "key", "burn", "high_quality_edges"
    )
    val crop = Seq("crop_offset_x", "crop_offset_y", "crop_width", "crop_height")
    val bounds = Option.when(crop.exists(in.contains)):
      val (x, y) = (in.integer("crop_offset_x", 0), in.integer("crop_offset_y", 0))
      val (w, h) = (in.integer("crop_width", width), in.integer("crop_height", height))
      Param.int("pixelbounds", in.at, x, x + w, y, y + h)
    val format = in.text("pixel_format", "rgb").toLowerCase
    val formatPosition = in.atOf("pixel_format")
    if !Views.PixelFormats.contains(format) then
      session.error(
        Code.UnknownType,
        formatPosition,
        s"unknown `pixel_format` `$format`",
        candela.diagnostics.Suggest.help(format, Views.PixelFormats)
      )
    else if !format.startsWith("rgb") then
      session.warn(
        Code.Unsupported,
        formatPosition,
        s"`pixel_format` `$format` is not supported; red, green and blue are written"
      )
    val alpha =
      Option.when(format.endsWith("a"))(Param.bool("alpha", formatPosition, true))
    val isHalf = in.text("component_format", "float16").toLowerCase == "float16"
    val params = Seq(
      Param.int("xresolution", in.atOf("width"), width),
      Param.int("yresolution", in.atOf("height"), height),
      Param.string("filename", in.at, s"${FileName.stem(scene)}.exr"),
      Param.bool("savefp16", in.at, isHalf),
      Param.bool("sampleborder", in.atOf("sample_border"), in.flag("sample_border", false))
    ) ++ bounds ++ alpha
    (width, height, session.declare("Film", "rgb", in.at, params))

  private def filterOf(in: Properties): Declaration =
    def filter(name: String, radius: Double, extra: Param*) =
      val size = Seq("xradius", "yradius").map(Param.float(_, in.at, radius.toFloat))
      session.declare("PixelFilter", name, in.at, size ++ extra)
    def number(name: String, x: Double) = Param.float(name, in.at, x.toFloat)
    in.plugin.name match
      case "box" => filter("box", 0.5)
      case "tent" => filter("triangle", in.number("radius", 1))
      case "mitchell" =>
        filter(
          "mitchell",
          2,
          number("B", in.number("B", 1.0 / 3)),
          number("C", in.number("C", 1.0 / 3))
        )
      case "catmullrom" => filter("mitchell", 2, number("B", 0), number("C", 0.5))
      case "lanczos" =>
        val lobes = in.integer("lobes", 3)
        filter("sinc", lobes, number("tau", lobes))
      case other =>
        if other != "gaussian" then Plugins.unsupported(in.plugin, "using \"gaussian\"", session)
        val sigma = in.number("stddev", 0.5)
        filter("gaussian", 4 * sigma, number("sigma", sigma))

  private def samplerOf(in: Properties): Declaration =
    in.ignore("seed", "jitter", "strength")
    val count = in.integer("sample_count", 4)
    if count < 1 then
      Values.fail(Code.ParameterValue, in.atOf("sample_count"), "`sample_count` must be at least 1")
    def sampler(name: String, params: Param*) = session.declare("Sampler", name, in.at, params)
    val countPosition = in.atOf("sample_count")
    in.plugin.name match
      case "ldsampler" => sampler("paddedsobol", Param.int("pixelsamples", countPosition, count))
      case "stratified" | "multijitter" | "orthogonal" =>
        val x = Math.ceil(Math.sqrt(count)).toInt
        sampler(
          "stratified",
          Param.int("xsamples", countPosition, x),
          Param.int("ysamples", countPosition, x)
        )
      case other =>
        if other != "independent" then
          Plugins.unsupported(in.plugin, "using \"independent\"", session)
        sampler("independent", Param.int("pixelsamples", countPosition, count))

private object Views:
  private val PixelFormats =
    Vector("luminance", "luminance_alpha", "rgb", "rgba", "xyz", "xyza", "multichannel")
