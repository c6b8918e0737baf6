package candela.models

import candela.diagnostics.{Code, Problem, SourcePos}
import candela.color.Rgb
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

/** Translates textures, each use of an image once. */
private[models] final class Textures(file: GltfFile, session: Session):
  private val entries = file.root.list("textures")
  private val images = file.root.list("images")
  private val samplers = file.root.list("samplers")
  private val described = mutable.LinkedHashMap.empty[String, TextureDescription]
  private val names = mutable.HashMap.empty[Any, String]

  /** Names of the files of images that textures use. */
  private val files: Map[Int, String] =
    val imageIndices = entries.flatMap(source).map(_.size).distinct.filter(images.indices.contains)
    imageIndices.flatMap(i => session.attempt(file.imageName(images(i))).map(i -> _)).toMap

  session.folder = session.folder.withParts(file.parts)

  def result(): Vector[TextureDescription] = described.values.toVector

  /** The image of a texture, if one of its formats is supported. */
  private def source(texture: Json): Option[Json] =
    texture.extension(Textures.WebP).flatMap(_("source")).orElse(texture("source"))

  /** What a `textureInfo` refers to. */
  def picture(info: Json): Option[Picture] =
    val texture = info.required("index").element(entries, "textures")
    val foreign = texture("extensions").toVector.flatMap(_.names).filter(_ != Textures.WebP)
    if source(texture).isDefined then
      for e <- foreign do
        session.warn(texture.at, s"images of `$e` are not supported; using `source`")
    else if foreign.isEmpty then session.warn(texture.at, "the texture has no image; ignored")
    else
      val message = s"images of `${foreign.head}` are not supported; the texture is left out"
      session.report(
        Problem.warning(Code.Unsupported, texture.at, message).withHelp(Remedies.of(foreign.head))
      )
    for
      index <- source(texture)
      _ = index.element(images, "images")
      name <- files.get(index.size)
    yield
      val sampler = texture.element("sampler", samplers, "samplers")
      val transform = info.extension("KHR_texture_transform")
      val set = transform.flatMap(_("texCoord")).orElse(info("texCoord")).fold(0)(_.size)
      if set > 1 then
        session.warn(info.at, s"TEXCOORD_$set is not supported; using TEXCOORD_1")
      Picture(
        name,
        set > 0,
        transform.fold(Textures.Upright)(rows),
        wrap(sampler),
        sampler.flatMap(_("magFilter")).forall(_.int != Textures.Nearest),
        info.at
      )

  private def rows(transform: Json): Vector[Float] =
    val offset = transform("offset").fold(Vector(0.0, 0.0))(_.numbers(2))
    val scale = transform("scale").fold(Vector(1.0, 1.0))(_.numbers(2))
    val angle = transform.number("rotation", 0)
    val (c, s) = (Math.cos(angle), Math.sin(angle))
    Vector(
      c * scale(0),
      -s * scale(1),
      s * scale(1) + offset(0),
      s * scale(0),
      c * scale(1),
      1 - c * scale(1) - offset(1)
    ).map(x => Math.rint(x * 1e7) / 1e7).map(_.toFloat)

  private def wrap(sampler: Option[Json]): Wraps =
    def mode(name: String) = sampler.flatMap(_(name)).fold("repeat"): code =>
      Textures.Wraps.getOrElse(code.int, code.fail(s"unknown wrap mode ${code.int}"))
    Wraps(mode("wrapS"), mode("wrapT"))

  /** A colour times an image and the colours of the vertices, if there are such. */
  def color(
      name: String,
      factor: Rgb,
      info: Option[Json],
      at: SourcePos,
      hasColors: Boolean = false
  ): Param =
    val tint = Option.when(factor != Rgb.White)(factor)
    val textured = info.flatMap(picture).map(image(_, "spectrum", "sRGB", None, 1f))
    val vertices = Option.when(hasColors)(vertexColors("spectrum", at))
    val factors = textured.toVector ++ vertices
    if factors.isEmpty then Textures.rgb(name, factor, at)
    else
      val product = factors.reduce((a, b) => scaled(at, Param.texture("tex2", at, b), a))
      val tinted = tint.fold(product)(c => scaled(at, Textures.rgb("tex2", c, at), product))
      Param.texture(name, at, tinted)

  /** A number times a channel of an image and the alpha of the vertices, if there are such. */
  def number(
      name: String,
      factor: Double,
      info: Option[Json],
      channel: String,
      at: SourcePos,
      hasColors: Boolean = false,
      isInverted: Boolean = false
  ): Param =
    val scale = factor.toFloat
    val textured =
      info.flatMap(picture).map(image(_, "float", "linear", Some(channel), scale, isInverted))
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
        val mapping = Textures.Coordinates.zip(p.rows).zip(Textures.Upright)
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

private[models] object Textures:
  val WebP = "EXT_texture_webp"
  val Upright: Vector[Float] = Vector(1f, 0f, 0f, 0f, 1f, 0f)
  private val Coordinates = Vector("uscale", "uskew", "udelta", "vskew", "vscale", "vdelta")
  private val Nearest = 9728
  private val Wraps = Map(10497 -> "repeat", 33071 -> "clamp", 33648 -> "mirror")

  def rgb(name: String, c: Rgb, at: SourcePos): Param =
    Param.floats(ParamType.Rgb, name, at, Array(c.r, c.g, c.b))
