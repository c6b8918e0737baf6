package candela.mitsuba

import candela.base.NumberedNames
import candela.diagnostics.{Code, SourcePos, Suggest}
import candela.color.Rgb
import candela.scenefile.{
  AnimatedTransform, Declaration, Dialect, GraphicsState, Param, ParamType, TextureDescription
}

import scala.collection.mutable

/** Translates textures, each once.
  *
  * Mitsuba's v has its origin at the top of images, pbrt's at the bottom. Translated shapes have
  * pbrt's v, 1 − v of Mitsuba's.
  */
final class Textures(session: Session, colors: Colors):
  private val descriptions = Vector.newBuilder[TextureDescription]
  private val names =
    mutable.HashMap.empty[(Plugin, String, Float, Option[MeshAttributes]), Option[String]]
  private val numberedNames = NumberedNames()
  private val volumes = Volumes(session)
  private var depth = 0

  def result(): Vector[TextureDescription] = descriptions.result()

  /** The attributes of the mesh whose surface is being translated, if it uses any. */
  var mesh: Option[MeshAttributes] = None

  /** A colour parameter. */
  def color(name: String, shade: Shade, at: SourcePos, scale: Float = 1f): Param = shade match
    case Shade.Constant(c, _) => Textures.rgb(name, c * scale, at)
    case Shade.Textured(t) =>
      this(t, "spectrum", scale).fold(Textures.rgb(name, Textures.Fallback * scale, at)):
        Param.texture(name, at, _)

  /** A number or texture. */
  def number(name: String, in: Properties, property: String, default: Double): Param =
    in.note(property, Textures.NumberKind, Properties.text(default))
    number(
      name,
      colors.shade(in, property, Rgb.gray(default.toFloat), Role.Reflectance),
      in.posOf(property)
    )

  def number(name: String, shade: Shade, at: SourcePos, scale: Float = 1f): Param = shade match
    case Shade.Constant(c, _) => Param.float(name, at, c.luminance * scale)
    case Shade.Textured(t) =>
      this(t, "float", scale).fold(Param.float(name, at, Textures.Fallback.r * scale)):
        Param.texture(name, at, _)

  /** Name of the texture; None if it is not supported. */
  private def apply(p: Plugin, valueType: String, scale: Float): Option[String] =
    names.getOrElseUpdate(
      (p, valueType, scale, mesh), {
        depth += 1
        if depth > Session.MaxDepth then
          Values.fail(
            Code.Circle,
            p.pos,
            s"more than ${Session.MaxDepth} textures refer to each other"
          )
        try define(p, valueType, scale)
        finally depth -= 1
      }
    )

  private def define(p: Plugin, valueType: String, scale: Float): Option[String] =
    if p.name == "scale" then session.translate(p)(scaled(_, valueType, scale))
    else plain(p, valueType, scale)

  /** A texture times a number or a colour. */
  private def scaled(in: Properties, valueType: String, scale: Float): Option[String] =
    val factor = colors.fixed(in, "scale", Rgb.White, Role.Unbounded)
    val isGrey = valueType == "float" || (factor.r == factor.g && factor.g == factor.b)
    val inner = in.nested("texture").headOption
    if inner.isEmpty then
      session.error(
        Code.MissingParameter,
        in.pos,
        s"${in.plugin.description} must contain a texture, or have a `value`"
      )
    inner.flatMap: p =>
      if isGrey then apply(p, valueType, scale * factor.luminance)
      else
        apply(p, valueType, scale).map: name =>
          val params = Seq(
            Param.texture("tex1", in.pos, name),
            Textures.rgb("tex2", factor, in.pos)
          )
          add(name, valueType, session.declare("Texture", "scale", in.pos, params, V3))

  private val V3 = Some(Dialect.V3)

  private def plain(p: Plugin, valueType: String, scale: Float): Option[String] =
    val parameters = p.name match
      case "bitmap" => session.translate(p)(bitmap(_, valueType)).map((_, GraphicsState.Identity))
      case "checkerboard" =>
        session.translate(p)(checkerboard(_, valueType)).map((_, GraphicsState.Identity))
      case "volume" => session.translate(p)(volume(_, valueType))
      case "mesh_attribute" =>
        session.translate(p)(attribute(_, valueType)).map((_, GraphicsState.Identity))
      case "vertexcolors" =>
        session.translate(p): in =>
          attribute(in, "vertex_color", 1f, mesh.flatMap(_.vertexColors), valueType)
        .map((_, GraphicsState.Identity))
      case "gridtexture" =>
        session.translate(p)(lines(_, valueType)).map((_, GraphicsState.Identity))
      case _ =>
        Plugins.unsupported(p, s"using ${Textures.Fallback.r}", session)
        None
    parameters.map: (typed, toWorld) =>
      val (name, params) = typed
      val t = session.declare("Texture", name, p.pos, params)
      val plain = add(p.id.getOrElse("texture"), valueType, t, toWorld)
      if scale == 1f then plain
      else
        val scaled = session.declare(
          "Texture",
          "scale",
          p.pos,
          Seq(Param.texture("tex", p.pos, plain), Param.float("scale", p.pos, scale))
        )
        add(plain, valueType, scaled)

  private def add(
      name: String,
      valueType: String,
      t: Declaration,
      toWorld: AnimatedTransform = GraphicsState.Identity
  ): String =
    val unique = numberedNames(name)
    descriptions += TextureDescription(unique, valueType, t, toWorld)
    unique

  private def bitmap(in: Properties, valueType: String): Option[(String, Seq[Param])] =
    val position = in.pos
    val filter = filterOf(in)
    val wrap = wrapOf(in)
    val encoding = encodingOf(in)
    in.ignore("format", "accel", "cache", "max_anisotropy")
    in.warnUnsupported("using the luminance of all of them", "channel")
    val mapping = coordinates(in, flipped = true)
    for
      name <- in.text("filename").orElse:
        session.error(Code.MissingParameter, position, "a bitmap must have a `filename`")
        None
    yield
      val at = in.posOf("filename")
      val isColor = valueType == "spectrum"
      // As for images of pbrt's scenes
      session.file(
        name,
        at,
        if isColor then Textures.UsingMagenta else "using the constant 1"
      ) match
        case None if isColor => "constant" -> Seq(Textures.rgb("value", Textures.Magenta, at))
        case None => "constant" -> Seq(Param.float("value", at, 1f))
        case Some(path) =>
          "imagemap" -> (Seq(
            Param.string("filename", at, session.named(path)),
            Param.string("filter", position, if filter == "nearest" then "point" else "bilinear"),
            Param.string("wrap", position, wrap),
            Param.string("encoding", position, encoding)
          ) ++ mapping)

  private def filterOf(in: Properties): String =
    val filter = in.word("filter_type", "bilinear", "bilinear", "nearest", "trilinear", "ewa")
    if filter == "trilinear" || filter == "ewa" then
      session.warn(
        Code.CorrectedValue,
        in.posOf("filter_type"),
        "images are not filtered over footprints; using `bilinear`"
      )
    filter

  /** Mitsuba 0.6 has one for u and one for v. */
  private def wrapOf(in: Properties): String =
    def word(name: String, default: String) =
      in.word(name, default, "repeat", "mirror", "clamp", "zero", "black", "one", "white")
    val defaultMode = word("wrap_mode", "repeat")
    val (u, v) = (word("wrap_mode_u", defaultMode), word("wrap_mode_v", defaultMode))
    if u != v then
      session.warn(
        Code.Unsupported,
        in.posOf("wrap_mode_v"),
        s"images are wrapped by u as by v; using `$u`"
      )
    u match
      case "zero" | "black" => "black"
      case "one" | "white" =>
        session.warn(
          Code.Unsupported,
          in.pos,
          s"the wrap mode `$u` is not supported; using `clamp`"
        )
        "clamp"
      case other => other

  /** By a flag, or by the exponent of Mitsuba 0.6. */
  private def encodingOf(in: Properties): String =
    if in.flag("raw", false) then "linear"
    else
      in.number("gamma", 0) match
        case 1.0 => "linear"
        case gamma if gamma > 0 => s"gamma ${gamma.toFloat}"
        case _ => "sRGB"

  /** Lines along integer u and v. */
  private def lines(in: Properties, valueType: String): Option[(String, Seq[Param])] =
    def color(ours: String, name: String, default: Float): Param =
      val shade = colors.shade(in, name, Rgb.gray(default), Role.Reflectance)
      if valueType == "float" then number(ours, shade, in.posOf(name))
      else this.color(ours, shade, in.posOf(name))
    val width = in.number("line_width", 0.01).toFloat
    Some("lines" -> (Seq(
      color("tex1", "color0", 0.2f),
      color("tex2", "color1", 0.4f),
      Param.float("linewidth", in.posOf("line_width"), width)
    ) ++ coordinates(in, flipped = false)))

  private def checkerboard(in: Properties, valueType: String): Option[(String, Seq[Param])] =
    def square(ours: String, name: String, default: Float): Param =
      val shade = colors.shade(in, name, Rgb.gray(default), Role.Reflectance)
      if valueType == "float" then number(ours, shade, in.posOf(name))
      else color(ours, shade, in.posOf(name))
    // Two squares of pbrt's are one period of Mitsuba's
    val mapping = coordinates(in, flipped = false, factor = 2f)
    // As a number, Mitsuba 3's has the two colours the other way round
    val isExchanged = valueType == "float" && !in.plugin.isOld
    val (even, odd) = if isExchanged then ("tex2", "tex1") else ("tex1", "tex2")
    Some("checkerboard" ->
      (Seq(square(even, "color0", 0.4f), square(odd, "color1", 0.2f)) ++ mapping))

  /** A grid in the world. */
  private def volume(
      in: Properties,
      valueType: String
  ): Option[((String, Seq[Param]), AnimatedTransform)] =
    for
      v <- in.objectNamed("volume").filter(_.name == "gridvolume").orElse:
        session.error(
          Code.MissingParameter,
          in.pos,
          s"${in.plugin.description} must have a `volume` of type \"gridvolume\""
        )
        None
      grid <- session.translate(v)(volumes(Float.PositiveInfinity))
    yield
      val values = if valueType == "float" then grid.numbers else grid.colors
      val params = grid.params(v.pos) :+ Param.floats(ParamType.Float, "values", v.pos, values)
      (("grid", params), GraphicsState.constant(grid.toWorld))

  /** A number or a colour at each point of the mesh. */
  private def attribute(in: Properties, valueType: String): Option[(String, Seq[Param])] =
    val name = in.text("name", "")
    attribute(in, name, in.number("scale", 1).toFloat, mesh.flatMap(_.grid(name)), valueType)

  private def attribute(
      in: Properties,
      name: String,
      scale: Float,
      grid: Option[(Int, Array[Float])],
      valueType: String
  ): Option[(String, Seq[Param])] =
    if grid.isEmpty then
      session.warn(
        Code.CorrectedValue,
        in.posOf("name"),
        s"the mesh has no attribute `$name`; using ${Textures.Fallback.r}",
        mesh.flatMap(m => Suggest.help(name, m.names.toVector))
      )
    for m <- mesh; (channels, values) <- grid yield
      if in.plugin.name == "mesh_attribute" then warnOfIntegers(in, name, values)
      val wanted = if valueType == "float" then 1 else 3
      val cells = m.width * m.height
      def value(cell: Int, c: Int) =
        if channels == wanted then values(cell * channels + c)
        else if channels < 3 then values(cell * channels)
        else if wanted == 3 then values(cell * channels + c)
        else
          Rgb(values(cell * channels), values(cell * channels + 1), values(cell * channels + 2))
            .luminance
      val texels = Array.tabulate(cells * wanted)(i => value(i / wanted, i % wanted) * scale)
      val position = in.pos
      (
        "grid",
        Seq(
          Param.int("nx", position, m.width),
          Param.int("ny", position, m.height),
          Param.string("mapping", position, "uv"),
          Param.floats(ParamType.Float, "values", position, texels)
        )
      )

  /** Colours of bytes are not divided by 255, in Mitsuba neither. */
  private def warnOfIntegers(in: Properties, name: String, values: Array[Float]): Unit =
    val isOfIntegers = values.forall(x => x == Math.rint(x.toDouble)) && values.exists(_ > 1f)
    if name.contains("color") && isOfIntegers && !in.contains("scale") then
      session.warn(
        Code.CorrectedValue,
        in.posOf("name"),
        s"`$name` has integers above 1, which are used as they are, as in Mitsuba",
        Some(s"""for colours from 0 to 255, add <float name="scale" value="${1f / 255f}"/>""")
      )

  /** @param flipped whether the texture's own v has its origin at the top, as images have */
  private def coordinates(in: Properties, flipped: Boolean, factor: Float = 1f): Seq[Param] =
    Seq("uscale", "uskew", "udelta", "vskew", "vscale", "vdelta").zip(mapping(in, flipped))
      .map((name, x) => (name, x * factor))
      .filter((name, x) => if name.endsWith("scale") then x != 1f else x != 0f)
      .map((name, x) => Param.float(name, in.pos, x))

  /** Of an image, by pbrt's u, v and 1: two rows of three factors. */
  def imageMapping(in: Properties): Vector[Float] = mapping(in, flipped = true)

  private def mapping(in: Properties, flipped: Boolean): Vector[Float] =
    val m = in.transform("to_uv").m
    // With v = 1 − ours
    val (su, skewU, du) = (m(0), -m(1), m(1) + m(3))
    val (skewV, sv, dv) = (m(4), -m(5), m(5) + m(7))
    val (across, up, shift) = if flipped then (-skewV, -sv, 1 - dv) else (skewV, sv, dv)
    Vector(su, skewU, du, across, up, shift).map(_.toFloat)

object Textures:
  /** Elements by which numbers that may vary are given. */
  val NumberKind = "float, texture"

  /** Parameters of bitmaps of Mitsuba 0.6. */
  val OldOptions: Vector[String] =
    Vector("gamma", "cache", "max_anisotropy", "wrap_mode_u", "wrap_mode_v")

  /** Instead of a texture that is not supported. */
  val Fallback: Rgb = Rgb.gray(0.5f)

  /** Instead of an image that is missing. */
  val Magenta: Rgb = Rgb(1f, 0f, 1f)
  val UsingMagenta = "using magenta"

  /** The mapping of an image that lies on u and v as they are. */
  val Upright: Vector[Float] = Vector(1f, 0f, 0f, 0f, 1f, 0f)

  def rgb(name: String, c: Rgb, at: SourcePos): Param =
    Param.floats(ParamType.Rgb, name, at, Array(c.r, c.g, c.b))
