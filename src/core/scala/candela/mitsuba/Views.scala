package candela.mitsuba

import candela.diagnostics.{Code, SourcePos}
import candela.math.{Transform, Vec3}
import candela.scenefile.{Declaration, GraphicsState, Param, SceneDescription}

import java.util.Locale

/** Translates sensors with their films, filters and samplers.
  *
  * @param image name of the image, without a suffix
  */
final class Views(session: Session, media: Media, image: String):

  /** The scene as seen by a sensor. */
  def addSensor(p: Plugin, from: SceneDescription): SceneDescription =
    session.translate(p): in =>
      val (width, height, film) = in.single("film") match
        case Some(f) => session.translate(f)(filmOf)
        case None => filmOf(Properties(plain("film", "hdrfilm", in.pos), session))
      val (seenWidth, seenHeight) =
        session.resolution.fold((width, height))(_.of(width, height))
      val filter = in.nested("film").headOption
        .flatMap(f => Properties(f, session).single("rfilter"))
        .getOrElse(plain("rfilter", "gaussian", in.pos))
      val sampler =
        in.single("sampler").getOrElse(plain("sampler", "independent", in.pos))
      in.ignore("srf")
      val toWorld = in.motion("to_world").getOrElse(GraphicsState.Identity)
      val medium = in.nested("medium").headOption.fold("")(media(_))
      val axes = SensorAxes.of(p.name)
      val toCamera = GraphicsState.inverse(toWorld.after(GraphicsState.constant(axes)))
      from.copy(
        camera = Some(camera(in, seenWidth, seenHeight)),
        worldToCamera = toCamera,
        cameraMedium = medium,
        film = Some(film),
        filter = Some(session.translate(filter)(filterOf)),
        sampler = Some(session.translate(sampler)(samplerOf))
      )

  private def plain(kind: String, name: String, at: SourcePos): Plugin =
    Plugin(kind, name, None, at, Vector.empty)

  private def camera(in: Properties, width: Int, height: Int): Declaration =
    def asWritten(name: String, ours: String, default: String): Vector[Param] =
      in.note(name, "float", default)
      in.number(name).map(x => Param.float(ours, in.posOf(name), x.toFloat)).toVector
    val shutter = asWritten("shutter_open", "shutteropen", "0") ++
      asWritten("shutter_close", "shutterclose", "0")
    val clips =
      asWritten("near_clip", "nearclip", "0.01") ++ asWritten("far_clip", "farclip", "10000")
    val always = shutter ++ clips
    val aspect = width.toDouble / height
    val dx = in.number("principal_point_offset_x", 0)
    val dy = in.number("principal_point_offset_y", 0)
    val (halfX, halfY) = if aspect >= 1 then (aspect, 1.0) else (1.0, 1 / aspect)
    def window(halfX: Double, halfY: Double) =
      val (cx, cy) = (2 * dx * halfX, -2 * dy * halfY)
      val sides = Seq(cx - halfX, cx + halfX, cy - halfY, cy + halfY).map(_.toFloat)
      Param.float("screenwindow", in.pos, sides*)
    def lens(scale: Double) =
      val focus = in.number("focus_distance").orElse(in.number("far_clip")).getOrElse(1e4)
      Seq(
        Param.float("lensradius", in.pos, (in.number("aperture_radius", 0) / scale).toFloat),
        Param.float("focaldistance", in.posOf("focus_distance"), (focus / scale).toFloat)
      )
    in.plugin.name match
      case "orthographic" | "telecentric" =>
        val isFlat = in.plugin.name == "orthographic"
        // The lens is as large in the world as it says
        val scale = in.transform("to_world").vector(Vec3.X).length
        if isFlat then in.ignore("focus_distance")
        session.declare(
          "Camera",
          "orthographic",
          in.pos,
          (always :+ window(1, 1 / aspect)) ++ (if isFlat then Nil else lens(scale))
        )
      case "spherical" =>
        in.ignore("near_clip", "far_clip")
        val layout = Param.string("mapping", in.pos, "equirectangular")
        session.declare("Camera", "spherical", in.pos, shutter :+ layout)
      case name =>
        if !Views.Perspective(name) then
          Plugins.unsupported(in.plugin, "using \"perspective\"", session)
          in.ignore(in.plugin.properties.map(_.name)*)
        for coefficients <- in.text("kc") do
          if name != "perspective_rdist" || coefficients.exists(c => c >= '1' && c <= '9') then
            in.warnUnsupported("the image is not distorted", "kc")
        if name != "thinlens" then in.ignore("focus_distance")
        val view =
          Seq(Param.float("fov", in.posOf("fov"), FieldOfView.shorter(in, aspect).toFloat)) ++
            Option.when(dx != 0 || dy != 0)(window(halfX, halfY))
        val optics = if name == "thinlens" then lens(1) else Nil
        session.declare("Camera", "perspective", in.pos, view ++ optics ++ always)

  /** Width and height in pixels, and the film. */
  private def filmOf(in: Properties): (Int, Int, Declaration) =
    if !Plugins.films.contains(in.plugin.name) then
      Plugins.unsupported(in.plugin, "using \"hdrfilm\"", session)
    val isText = in.plugin.name == "mfilm"
    val width = in.integer("width", if isText then 1 else 768)
    val height = in.integer("height", if isText then 1 else 576)
    if width < 1 || height < 1 then
      Values.fail(Code.TooLarge, in.pos, s"a film can't have $width × $height pixels")
    in.nested("rfilter"): Unit
    in.ignore("file_format", "banner", "compensate", "attach_log", "digits", "variable")
    if in.text("tonemap_method", "gamma").toLowerCase(Locale.ROOT) != "gamma" then
      in.warnUnsupported(Views.Linear, "tonemap_method")
    for (name, neutral) <- Views.ToneDefaults if in.number(name).exists(_ != neutral) do
      in.warnUnsupported(Views.Linear, name)
    for p <- in.plugin.properties if p.name.startsWith("label[") || p.name.startsWith("metadata[")
    do in.warnUnsupported("nothing is written in its place", p.name)
    val crop = Seq("crop_offset_x", "crop_offset_y", "crop_width", "crop_height")
    val bounds = Option.when(crop.exists(in.contains)):
      val (x, y) = (in.integer("crop_offset_x", 0), in.integer("crop_offset_y", 0))
      val (w, h) = (in.integer("crop_width", width), in.integer("crop_height", height))
      Param.int("pixelbounds", in.pos, x, x + w, y, y + h)
    // Only multichannel integrators have several
    val formats =
      in.text("pixel_format", "rgb").toLowerCase(Locale.ROOT).split("[\\s,]+").filter(_.nonEmpty)
    val format = formats.headOption.getOrElse("rgb")
    in.ignore("channel_names")
    val formatPosition = in.posOf("pixel_format")
    if !Views.PixelFormats.contains(format) then
      session.error(
        Code.UnknownType,
        formatPosition,
        s"unknown `pixel_format` `$format`",
        candela.diagnostics.Suggest.help(format, Views.PixelFormats)
      )
    else if !Views.Channels.exists(format.startsWith) then
      session.warn(
        Code.Unsupported,
        formatPosition,
        s"`pixel_format` `$format` is not supported; red, green and blue are written"
      )
    val alpha =
      Option.when(format.endsWith("a"))(Param.bool("alpha", formatPosition, true))
    val channels = Views.Channels.filter(c => c != "rgb" && format.startsWith(c))
      .map(Param.string("pixelformat", formatPosition, _))
    val edges = in.flag("high_quality_edges", false)
    val samplesBorder = in.flag("sample_border", edges)
    val isHalf = in.text("component_format", "float16").toLowerCase(Locale.ROOT) == "float16"
    val params = Seq(
      Param.int("xresolution", in.posOf("width"), width),
      Param.int("yresolution", in.posOf("height"), height),
      Param.string("filename", in.pos, s"$image.exr"),
      Param.bool("savefp16", in.pos, isHalf),
      Param.bool("sampleborder", in.posOf("sample_border"), samplesBorder)
    ) ++ channels ++ bounds ++ alpha ++ in.number("exposure").filter(_ != 0).map: stops =>
      Param.float("exposure", in.posOf("exposure"), stops.toFloat)
    (width, height, session.declare("Film", "rgb", in.pos, params))

  private def filterOf(in: Properties): Declaration =
    def filter(name: String, radius: Double, extra: Param*) =
      val size = Seq("xradius", "yradius").map(Param.float(_, in.pos, radius.toFloat))
      session.declare("PixelFilter", name, in.pos, size ++ extra)
    def number(name: String, x: Double) = Param.float(name, in.pos, x.toFloat)
    in.plugin.name match
      case "box" => filter("box", in.number("radius", 0.5))
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
    in.ignore("seed", "jitter", "strength", "scramble", "dimension")
    val count = in.integer("sample_count", 4)
    if count < 1 then
      Values.fail(
        Code.ParameterValue,
        in.posOf("sample_count"),
        "`sample_count` must be at least 1"
      )
    def sampler(name: String, params: Param*) = session.declare("Sampler", name, in.pos, params)
    val countPosition = in.posOf("sample_count")
    in.plugin.name match
      case "ldsampler" => sampler("paddedsobol", Param.int("pixelsamples", countPosition, count))
      case "sobol" => sampler("sobol", Param.int("pixelsamples", countPosition, count))
      case "halton" | "hammersley" =>
        if in.plugin.name == "hammersley" then
          val message = s"${in.plugin.description} is not supported; using \"halton\""
          session.warn(Code.Unsupported, in.pos, message)
        sampler("halton", Param.int("pixelsamples", countPosition, count))
      case "stratified" | "multijitter" | "orthogonal" =>
        val x = Math.ceil(Math.sqrt(count)).toInt
        if x * x != count then
          val message = s"`sample_count` $count becomes ${x * x}, the next square number"
          session.warn(Code.CorrectedValue, countPosition, message)
        sampler(
          "stratified",
          Param.int("xsamples", countPosition, x),
          Param.int("ysamples", countPosition, x)
        )
      case other =>
        if other != "independent" then
          Plugins.unsupported(in.plugin, "using \"independent\"", session)
        sampler("independent", Param.int("pixelsamples", countPosition, count))

private[mitsuba] object Views:
  private val PixelFormats =
    Vector("luminance", "luminance_alpha", "luminancealpha", "rgb", "rgba", "xyz", "xyza",
      "spectrum", "spectrumalpha", "multichannel")

  /** Channels of colours that are written. */
  private val Channels = Vector("rgb", "luminance", "xyz")

  private val Perspective = Set("perspective", "perspective_rdist", "thinlens")

  /** Parameters of tone mapping, with values that change nothing. */
  private val ToneDefaults =
    Seq("gamma" -> -1.0, "key" -> 0.18, "burn" -> 0.0)
  private val Linear = "the image has linear values"

  /** Samples per pixel of a sampler's statement. */
  def sampleCount(sampler: Declaration): Int =
    def number(name: String) = sampler.param(name).flatMap(_.ints.headOption)
    number("pixelsamples").orElse(number("xsamples").map(x => x * x)).getOrElse(1)

/** From the axes of pbrt's cameras to those of Mitsuba's sensors. */
object SensorAxes:
  def of(sensor: String): Transform = if sensor == "spherical" then Panorama else Plain

  /** Mitsuba's x points left, pbrt's right. */
  val Plain: Transform = Transform.scale(-1, 1, 1).get

  /** The azimuth of panoramas begins at Mitsuba's −z, at pbrt's x. */
  private val Panorama =
    Transform.fromRows(Vector(0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1)).get
