package candela.models

import candela.color.Rgb
import candela.diagnostics.{Code, SourcePos}
import candela.scenefile.{Declaration, Dialect, GraphicsState, Param, ParamType, TextureDescription}

import scala.collection.mutable

/** An image on a surface: its file, and how u and v lie on it.
  *
  * @param second whether by the second set of u and v
  * @param rows   s and t by u, v and 1, where v and t begin at the bottom
  */
private[models] final case class Picture(
    file: String,
    second: Boolean,
    rows: Vector[Float],
    wrap: Wraps,
    isSmooth: Boolean,
    at: SourcePos
)

/** Wrap modes along s and t. */
private[models] final case class Wraps(s: String, t: String):
  /** Parameters of these names; those that are the default of an image are left out. */
  def params(names: (String, String), at: SourcePos): Vector[Param] =
    Vector(
      Option.when(s != "repeat" || t != s)(Param.string(names._1, at, s)),
      Option.when(t != s)(Param.string(names._2, at, t))
    ).flatten

private[models] object Picture:
  val Upright: Vector[Float] = Vector(1f, 0f, 0f, 0f, 1f, 0f)
  private[models] val Coordinates =
    Vector("uscale", "uskew", "udelta", "vskew", "vscale", "vdelta")

  def rgb(name: String, c: Rgb, at: SourcePos): Param =
    Param.floats(ParamType.Rgb, name, at, Array(c.r, c.g, c.b))

/** Describes textures of images and of the colours of vertices, each once. */
private[models] class Pictures(session: Session):
  private val described = mutable.LinkedHashMap.empty[String, TextureDescription]
  private val names = mutable.HashMap.empty[Any, String]

  def result(): Vector[TextureDescription] = described.values.toVector

  /** A colour times an image and the colours of the vertices, if there are such. */
  def colorOf(
      name: String,
      factor: Rgb,
      picture: Option[Picture],
      at: SourcePos,
      hasColors: Boolean = false
  ): Param =
    val tint = Option.when(factor != Rgb.White)(factor)
    val textured = picture.map(image(_, "spectrum", "sRGB", None, 1f))
    val vertices = Option.when(hasColors)(vertexColors("spectrum", at))
    val factors = textured.toVector ++ vertices
    if factors.isEmpty then Picture.rgb(name, factor, at)
    else
      val product = factors.reduce((a, b) => scaled(at, Param.texture("tex2", at, b), a))
      val tinted = tint.fold(product)(c => scaled(at, Picture.rgb("tex2", c, at), product))
      Param.texture(name, at, tinted)

  /** A number times a channel of an image and the alpha of the vertices, if there are such. */
  def numberOf(
      name: String,
      factor: Double,
      picture: Option[Picture],
      channel: String,
      at: SourcePos,
      hasColors: Boolean = false,
      isInverted: Boolean = false
  ): Param =
    val scale = factor.toFloat
    val textured =
      picture.map(image(_, "float", "linear", Some(channel), scale, isInverted))
    val vertices = Option.when(hasColors)(vertexColors("float", at))
    (textured, vertices) match
      case (None, None) => Param.float(name, at, if isInverted then 1f - scale else scale)
      case (Some(one), None) => Param.texture(name, at, one)
      case (None, Some(one)) =>
        Param.texture(name, at, times(at, one, Param.float("scale", at, scale)))
      case (Some(a), Some(b)) =>
        Param.texture(name, at, times(at, a, Param.texture("scale", at, b)))

  private def times(at: SourcePos, texture: String, by: Param): String =
    add(
      "float",
      session.declare("Texture", "scale", at, Seq(Param.texture("tex", at, texture), by))
    )

  private def scaled(at: SourcePos, by: Param, texture: String): String =
    val params = Seq(Param.texture("tex1", at, texture), by)
    add("spectrum", session.declare("Texture", "scale", at, params, Some(Dialect.V3)))

  private def vertexColors(kind: String, at: SourcePos): String =
    names.getOrElseUpdate(kind, add(kind, session.declare("Texture", "vertexcolor", at, Nil)))

  private def image(
      p: Picture,
      kind: String,
      encoding: String,
      channel: Option[String],
      scale: Float,
      isInverted: Boolean = false
  ): String =
    names.getOrElseUpdate(
      (p.copy(at = SourcePos.Nowhere), kind, encoding, channel, scale, isInverted), {
        val at = p.at
        val mapping = Picture.Coordinates.zip(p.rows).zip(Picture.Upright)
          .collect { case ((name, x), usual) if x != usual => Param.float(name, at, x) }
        val params = Vector(
          Param.string("filename", at, p.file),
          Param.string("encoding", at, encoding)
        ) ++ mapping ++
          p.wrap.params(("wrap", "wrapt"), at) ++
          Option.when(!p.isSmooth)(Param.string("filter", at, "point")) ++
          channel.map(Param.string("channel", at, _)) ++
          Option.when(scale != 1f)(Param.float("scale", at, scale)) ++
          Option.when(isInverted)(Param.bool("invert", at, true)) ++
          Option.when(p.second)(Param.bool("uv2", at, true))
        add(kind, session.declare("Texture", "imagemap", at, params))
      }
    )

  private def add(kind: String, texture: Declaration): String =
    val name = s"texture ${described.size + 1}"
    described(name) = TextureDescription(name, kind, texture, GraphicsState.Identity)
    name

  /** The normal map of a material.
    *
    * @param prefix of the names of its parameters
    */
  def normalMap(p: Picture, scale: Double, prefix: String = ""): Vector[Param] =
    def name(of: String) = s"${prefix}normal$of"
    Vector(Param.string(name("map"), p.at, p.file), Param.bool("softedges", p.at, false)) ++
      Option.when(p.rows != Picture.Upright):
        Param.floats(ParamType.Float, name("mapuv"), p.at, p.rows.toArray)
      ++ p.wrap.params((name("wrap"), name("wrapt")), p.at)
      ++ Option.when(p.second)(Param.bool(name("uv2"), p.at, true)) ++
      Option.when(scale != 1)(Param.float(name("scale"), p.at, scale.toFloat))

  /** The area light of a colour times an image. */
  def light(
      color: Rgb,
      picture: Option[Picture],
      isTwoSided: Boolean,
      at: SourcePos
  ): Declaration =
    val params = picture match
      case None => Vector(Picture.rgb("L", color, at))
      case Some(p) =>
        Vector(
          Param.string("filename", at, p.file),
          Picture.rgb("tint", color * (1f / color.max), at),
          Param.float("scale", at, color.max),
          Param.string("wrap", at, p.wrap.s)
        ) ++
          Option.when(p.wrap.t != p.wrap.s)(Param.string("wrapt", at, p.wrap.t)) ++
          Option.when(p.second)(Param.bool("uv2", at, true)) ++
          Option.when(!p.isSmooth)(Param.string("filter", at, "point")) ++
          Option.when(p.rows != Picture.Upright):
            Param.floats(ParamType.Float, "imageuv", at, p.rows.toArray)
    val sides = Option.when(isTwoSided)(Param.bool("twosided", at, true))
    session.declare("AreaLightSource", "diffuse", at, params ++ sides)

  /** The image by its name; or by the last part of a name of another computer, as viewers do. */
  def fileName(folder: String, file: String, at: SourcePos): String =
    val name = file.replace('\\', '/')
    val isAbsolute = name.startsWith("/") || Pictures.DriveLetter.findPrefixOf(name).isDefined
    val wanted = if isAbsolute then name else folder + name
    def locate(name: String) = session.folder.locate(name, Some(at))
    val last = folder + name.drop(name.lastIndexOf('/') + 1)
    val isForeign = isAbsolute && session.folder.belonging(wanted).isEmpty ||
      locate(wanted).isEmpty
    val located = if isForeign && locate(last).isDefined then last else wanted
    if located != wanted then
      session.warn(at, s"no such file: `$wanted`; using `$located`", Code.NoSuchFile)
    locate(located).foreach(file => session.note(file.path))
    located

private object Pictures:
  private val DriveLetter = "[A-Za-z]:".r
