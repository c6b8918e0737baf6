package candela.models

import candela.color.Rgb
import candela.diagnostics.{Code, Problem, SourcePos}
import candela.scenefile.Param

/** Translates textures of glTF. */
private[models] final class Textures(file: GltfFile, session: Session) extends Pictures(session):
  private val entries = file.root.list("textures")
  private val images = file.root.list("images")
  private val samplers = file.root.list("samplers")

  /** Names of the files of images that textures use. */
  private val files: Map[Int, String] =
    val imageIndices = entries.flatMap(source).map(_.size).distinct.filter(images.indices.contains)
    imageIndices.flatMap(i => session.attempt(file.imageName(images(i))).map(i -> _)).toMap

  session.folder = session.folder.withParts(file.parts)

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
        transform.fold(Picture.Upright)(rows),
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

  def color(
      name: String,
      factor: Rgb,
      info: Option[Json],
      at: SourcePos,
      hasColors: Boolean = false
  ): Param = colorOf(name, factor, info.flatMap(picture), at, hasColors)

  def number(
      name: String,
      factor: Double,
      info: Option[Json],
      channel: String,
      at: SourcePos,
      hasColors: Boolean = false,
      isInverted: Boolean = false
  ): Param = numberOf(name, factor, info.flatMap(picture), channel, at, hasColors, isInverted)

private[models] object Textures:
  val WebP = "EXT_texture_webp"
  private val Nearest = 9728
  private val Wraps = Map(10497 -> "repeat", 33071 -> "clamp", 33648 -> "mirror")
