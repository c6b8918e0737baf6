package candela.mitsuba

import candela.diagnostics.{Code, SourcePos}
import candela.io.InputFile
import candela.math.{Transform, Vec3}
import candela.scenefile.Param

/** The shape of a statement. */
private[mitsuba] final case class Form(
    name: String,
    params: Seq[Param],
    toWorld: Transform,
    isReversed: Boolean
):
  /** Not seen from within. */
  def culled(in: Properties): Form =
    copy(params = params :+ Param.bool("cullbackfaces", in.pos, true))

/** Translates shapes that only Mitsuba 0.6 has.
  *
  * @param fileOf the file that a shape names
  * @param params those of a mesh
  */
private[mitsuba] final class OldShapes(
    session: Session,
    fileOf: Properties => Option[InputFile],
    params: (Mesh, Properties) => Seq[Param]
):

  /** The hair of Mitsuba 0.6: straight round fibres, as tubes, or as pbrt's ribbons if these suit
    * their BSDF or are too many to be tubes.
    */
  def hair(in: Properties, suitsRibbons: Boolean): Vector[Form] =
    val isFlipped = in.flag("flip_normals", false)
    val toWorld = in.transform("to_world")
    val reduction = in.number("reduction", 0)
    if !(reduction >= 0 && reduction < 1) then
      Values.fail(
        Code.ParameterValue,
        in.posOf("reduction"),
        s"`reduction` must be at least 0 and below 1, found $reduction"
      )
    val minCosine = Math.cos(Math.toRadians(in.number("angle_threshold", 1))).toFloat
    val scale = toWorld.vector(Vec3.Z).length / (1 - reduction)
    val radius = (in.number("radius", 0.025) * scale).toFloat
    fileOf(in).toVector.flatMap: file =>
      val fibres = HairFibres.reduced(HairFile.read(file, in.posOf("filename")), reduction)
        .map(HairFibres.placed(_, toWorld, minCosine)).filter(_.size > 1)
      val segments = fibres.map(_.size - 1).sum
      val isLarge = segments > OldShapes.MaxTubeSegments
      if isLarge && !suitsRibbons then
        session.warn(
          Code.Unsupported,
          in.pos,
          s"hair of $segments segments is too large for round fibres; using ribbons, which " +
            "shadow themselves"
        )
      if isLarge || suitsRibbons then
        val common = Vector(
          Param.string("type", in.pos, "cylinder"),
          Param.float("width", in.posOf("radius"), 2 * radius),
          // A segment is straight
          Param.float("splitdepth", in.pos, 0f)
        )
        fibres.map: f =>
          Form("curve", HairFibres.points(f, in.pos) +: common, Transform.Identity, false)
      else if fibres.isEmpty then Vector.empty
      else
        val mesh = Tubes.polylines(fibres, radius)
        Vector(Form("trianglemesh", params(mesh, in), Transform.Identity, isFlipped))

  /** Heights from an image, over the square of ±1 in the xy-plane. */
  def heightfield(in: Properties, toWorld: Transform, isFlipped: Boolean): Option[Form] =
    in.ignore("width", "height")
    in.nested("rfilter"): Unit
    val (name, factor) = in.nested("texture").headOption match
      case Some(t) => heights(t)
      case None =>
        val file = in.text("filename").map(_ -> in.posOf("filename"))
        if file.isEmpty then
          session.error(
            Code.MissingParameter,
            in.pos,
            s"${in.plugin.description} must have a `filename` or a texture"
          )
        (file, 1.0)
    val height = factor * in.number("scale", 1)
    val scale = Param.float("scale", in.posOf("scale"), height.toFloat)
    val smooth = Param.bool("smooth", in.pos, in.flag("shading_normals", true))
    name match
      case None => Some(Form("trianglemesh", params(Mesh.rectangle, in), toWorld, isFlipped))
      case Some((name, at)) =>
        session.file(name, at, "skipped").map: path =>
          val file = Param.string("filename", at, session.named(path))
          Form("heightmap", Seq(file, scale, smooth), toWorld, isFlipped)

  /** The file of a bitmap, and a factor. */
  private def heights(texture: Plugin): (Option[(String, SourcePos)], Double) = texture.name match
    case "bitmap" =>
      session.translate(texture): in =>
        in.ignore("filter_type", "wrap_mode", "max_anisotropy", "cache")
        in.warnUnsupported("ignored", "channel", "gamma", "to_uv")
        (in.text("filename").map(_ -> in.posOf("filename")), 1.0)
    case "scale" if Properties(texture, session).nested("texture").nonEmpty =>
      session.translate(texture): in =>
        val (name, factor) = heights(in.nested("texture").head)
        (name, factor * in.number("scale", 1))
    case _ =>
      val message = s"heights from a ${texture.description} are not supported; the field is flat"
      session.warn(Code.Unsupported, texture.pos, message)
      (None, 1.0)

private object OldShapes:
  /** Of hair that becomes tubes, with twelve triangles each. */
  private val MaxTubeSegments = 300_000
