package candela.mitsuba

import candela.base.{NumberedNames, loop}
import candela.diagnostics.Code
import candela.io.InputFile
import candela.build.shapes.PlyFile
import candela.math.Transform
import candela.scenefile.*

import scala.collection.mutable

/** Translates shapes, groups and instances. */
final class Shapes(session: Session, surfaces: Surfaces, emitters: Emitters, media: Media):
  private val world = Vector.newBuilder[ShapeDescription]
  private val groups = mutable.LinkedHashMap.empty[Plugin, (String, Vector[ShapeDescription])]
  private val groupNames = NumberedNames()
  private val placed = InstanceList.newBuilder

  private val oldShapes = OldShapes(session, fileOf, params)

  private var depth = 0

  def shapes: Vector[ShapeDescription] = world.result()
  def objects: Map[String, Vector[ShapeDescription]] =
    scala.collection.immutable.VectorMap.from(groups.values)
  def instances: InstanceList = placed.result()

  def add(p: Plugin): Unit =
    session.attempt(descriptions(p)).foreach(world ++= _)

  /** Shapes that move are translated where they would be without their transform. */
  private def descriptions(p: Plugin): Vector[ShapeDescription] =
    val motion = if p.name == "instance" then None else Properties(p, session).motion("to_world")
    motion.filter(_.isAnimated) match
      case None => ofType(p)
      case Some(moving) =>
        val unplaced = p.properties.filterNot(_.name == "to_world")
        ofType(Plugin(p.kind, p.name, p.id, p.pos, unplaced, p.isOld)).map: s =>
          s.copy(objectToWorld = moving.after(s.objectToWorld))

  private def ofType(p: Plugin): Vector[ShapeDescription] = p.name match
    case "shapegroup" =>
      group(p)
      Vector.empty
    case "instance" =>
      session.translate(p): in =>
        for g <- in.nested("shape").headOption do
          val placement = in.motion("to_world").getOrElse(GraphicsState.Identity)
          if g.name != "shapegroup" then
            session.error(
              Code.MissingParameter,
              in.pos,
              "an instance must contain a shapegroup, or refer to one"
            )
          else placed += InstanceDescription(group(g), in.pos, placement)
      Vector.empty
    case "deformable" =>
      session.translate(p): in =>
        session.warn(
          Code.Unsupported,
          in.pos,
          s"${p.description} is not supported; it does not move"
        )
        in.ignore(p.properties.map(_.name).filter(_.nonEmpty)*)
        // Its meshes are those of its times
        in.nested("shape").headOption.toVector.flatMap(descriptions)
    case "merge" =>
      depth += 1
      if depth > Session.MaxDepth then
        Values.fail(Code.Circle, p.pos, s"more than ${Session.MaxDepth} shapes within each other")
      try session.translate(p)(_.nested("shape").flatMap(descriptions))
      finally depth -= 1
    case _ => session.translate(p)(shape)

  /** The name of a group of shapes. */
  private def group(p: Plugin): String =
    groups.getOrElseUpdate(
      p, {
        val name = groupNames(p.id.getOrElse("group"))
        val inner = session.translate(p)(_.nested("shape"))
        val flat = inner.filterNot: s =>
          val isNested = s.name == "instance" || s.name == "shapegroup"
          if isNested then
            session.error(Code.Nesting, s.pos, s"a shapegroup can't contain an ${s.description}")
          isNested
        (name, flat.flatMap(descriptions))
      }
    )._1

  private def shape(in: Properties): Vector[ShapeDescription] =
    in.ignore("silhouette_sampling_weight", "filename_id")
    val emitter = in.single("emitter")
    in.nested("sensor"): Unit
    val bsdf = in.single("bsdf")
    val attributes = bsdf.flatMap(attributesFor(in, _))
    val scattering = in.nested("subsurface").headOption
    val (surface, material) = bsdf match
      case inner if scattering.isDefined =>
        val s = surfaces.scattering(scattering.get, inner.map(surfaces(_)))
        (s, MaterialRef.Inline(s.material))
      case Some(p) =>
        val s = attributes.fold(surfaces(p))(surfaces.onMesh(_, p))
        // Masks don't dim emitters
        val lit = if emitter.isDefined && s.alpha.isDefined then surfaces.inlineMask(s) else s
        (lit, if lit eq s then surfaces.ref(p, s) else MaterialRef.Inline(lit.material))
      case None =>
        val s = bare(in, emitter.isDefined)
        (s, MaterialRef.Inline(s.material))
    val isHair = surface.material.name == "hair"
    val forms = in.plugin.name match
      case "bsplinecurve" if isHair => ofHair(in)
      case "hair" => oldShapes.hair(in, suitsRibbons = isHair)
      case "linearcurve" if isHair =>
        curves(in, minPoints = 2, in.flag("flip_normals", false))(Tubes.capsules)
          .map(_.culled(in)).toVector
      case _ => form(in, attributes).toVector
    def ribbon =
      val m = surface.material
      MaterialRef.Inline(m.copy(params = m.params :+ Param.bool("ribbon", in.pos, true)))
    for Form(name, params, toWorld, isReversed) <- forms yield
      val alpha = surface.alpha.toVector
      def medium(side: String) = in.nested("medium", side).headOption.fold("")(media(_))
      ShapeDescription(
        session.declare("Shape", name, in.pos, params ++ alpha),
        GraphicsState.constant(toWorld),
        isReversed,
        if isHair && name == "curve" then ribbon else material,
        emitter.flatMap(emitters.area),
        medium("interior"),
        medium("exterior"),
        // Curves face the viewer
        surface.isOneSided && name != "curve"
      )

  /** Without a BSDF, emitters are black. */
  private def bare(in: Properties, emits: Boolean): Surface =
    val grey = candela.color.Rgb.gray(if emits then 0f else 0.5f)
    val material =
      session.declare("Material", "diffuse", in.pos, Seq(Textures.rgb("reflectance", grey, in.pos)))
    Surface(material, isOneSided = true)

  /** Of the mesh, if its surface uses them. */
  private def attributesFor(in: Properties, bsdf: Plugin): Option[MeshAttributes] =
    val types = surfaces.textureTypes(bsdf)
    if !types.exists(MeshAttributes.Types) || in.plugin.name != "ply" then None
    else
      if types.exists(Set("bitmap", "checkerboard", "gridtexture")) then
        session.warn(
          Code.Unsupported,
          in.pos,
          "textures by u and v are not supported beside attributes of a mesh; they lie elsewhere"
        )
      fileOf(in).map(file =>
        MeshAttributes(PlyFile.read(file, Some(in.pos), keepsAll = true), in.flag("srgb", true))
      )

  private def form(in: Properties, attributes: Option[MeshAttributes]): Option[Form] =
    val toWorld = in.transform("to_world")
    val isFlipped = in.flag("flip_normals", false)
    def number(name: String, x: Double) = Param.float(name, in.posOf(name), x.toFloat)
    in.plugin.name match
      case "sphere" =>
        val centre = in.triple("center").fold(Transform.Identity)(Transform.translate(_, _, _))
        // A reflection turns it inside out, in Mitsuba as in pbrt; so does a radius below 0
        val radius = in.number("radius", 1)
        val size = Seq(number("radius", Math.abs(radius)))
        Some(Form("sphere", size, toWorld * centre, isFlipped != radius < 0))
      case "cylinder" =>
        for (axisToWorld, length) <- axis(in, toWorld) yield
          // Upside down, so that v runs as on Mitsuba's; emitters have none, and pbrt's light of
          // reflected ones is not consistent
          val isEven =
            in.nested("emitter").nonEmpty && !in.nested("emitter").exists(isMapped)
          val down = if isEven then Transform.Identity else Transform.scale(1, 1, -1).get
          val toWorld = axisToWorld * down
          val ends = if down.isIdentity then Seq(0.0, length) else Seq(-length, 0.0)
          val radius = Math.abs(in.number("radius", 1))
          val size = Seq("radius" -> radius) ++ Seq("zmin", "zmax").zip(ends)
          Form("cylinder", size.map(number(_, _)), toWorld, isFlipped != toWorld.swapsHandedness)
      case "disk" =>
        // pbrt turns the normals of all reflected quadrics
        Some(Form("disk", Seq(number("radius", 1)), toWorld, isFlipped != toWorld.swapsHandedness))
      case "rectangle" =>
        val mesh = Mesh.rectangle.placed(toWorld)
        Some(Form(
          "trianglemesh",
          params(mesh, in),
          Transform.Identity,
          isFlipped != toWorld.swapsHandedness
        ))
      case "cube" => Some(meshForm(in, isFlipped, toWorld)(Mesh.cube))
      case "obj" =>
        val isUp = in.flag("flip_tex_coords", true)
        in.ignore("collapse")
        if in.flag("load_materials", false) then
          in.warnUnsupported("materials of .mtl files are not read", "load_materials")
        if in.integer("shape_index", -1) >= 0 then
          in.warnUnsupported("all parts of the file are read", "shape_index")
        mesh(in, toWorld, isFlipped)(ObjShape.read(_, isUp, in.pos))
      case "ply" =>
        val isUp = in.flag("flip_tex_coords", false)
        in.ignore("srgb")
        mesh(in, toWorld, isFlipped, attributes): file =>
          val ply = PlyFile.read(file, Some(in.pos))
          if isUp then loop(ply.uvs.length / 2)(i => ply.uvs(2 * i + 1) = 1 - ply.uvs(2 * i + 1))
          Mesh(ply.positions, ply.normals, ply.uvs, ply.indices, ply.rests)
      case "serialized" =>
        val index = in.integer("shape_index", 0)
        in.ignore("flip_tex_coords")
        mesh(in, toWorld, isFlipped)(SerializedFile.read(_, index, in.pos))
      case "heightfield" => oldShapes.heightfield(in, toWorld, isFlipped)
      case "bsplinecurve" => curves(in, minPoints = 4, isFlipped)(Tubes.splines)
      case "linearcurve" => curves(in, minPoints = 2, isFlipped)(Tubes.capsules)
      case _ =>
        Plugins.unsupported(in.plugin, "skipped", session)
        in.ignore(in.plugin.properties.map(_.name)*)
        None

  /** The place and length of a cylinder along z. */
  private def axis(in: Properties, toWorld: Transform): Option[(Transform, Double)] =
    val (x0, y0, z0) = in.triple("p0", (0, 0, 0))
    val (x1, y1, z1) = in.triple("p1", (0, 0, 1))
    val (dx, dy, dz) = (x1 - x0, y1 - y0, z1 - z0)
    val length = Math.sqrt(dx * dx + dy * dy + dz * dz)
    if !(length > 0) then
      session.error(Code.ParameterValue, in.pos, "the ends of a cylinder must differ")
    Option.when(length > 0):
      val frame = Shapes.frame(dx / length, dy / length, dz / length)
      (toWorld * Transform.translate(x0, y0, z0) * frame, length)

  private def mesh(
      in: Properties,
      toWorld: Transform,
      isFlipped: Boolean,
      attributes: Option[MeshAttributes] = None
  )(
      read: InputFile => Mesh
  ): Option[Form] =
    in.ignore("optimize_meshes", "use_inverse_transform", "is_alembic")
    val formed = meshForm(in, isFlipped, toWorld, attributes)
    fileOf(in).map(file => formed(read(file)))

  private def fileOf(in: Properties): Option[InputFile] = in.text("filename") match
    case None =>
      session.error(
        Code.MissingParameter,
        in.pos,
        s"${in.plugin.description} must have a `filename`"
      )
      None
    case Some(name) => session.file(name, in.posOf("filename"), "skipped")

  private def read(in: Properties, minPoints: Int): Option[Vector[CurvePoints]] =
    val toWorld = in.transform("to_world")
    fileOf(in).map(file =>
      CurvePoints.placed(CurveFile.read(file, minPoints, in.posOf("filename")), toWorld)
    )

  private def curves(in: Properties, minPoints: Int, isFlipped: Boolean)(
      tessellate: Vector[CurvePoints] => Mesh
  ): Option[Form] =
    read(in, minPoints).map: curvePoints =>
      // Through an open end, the far side is not seen from within
      val isOpen = minPoints == 4 && curvePoints.exists(_.isOpen)
      val form = Form(
        "trianglemesh",
        params(tessellate(curvePoints), in),
        curvePoints.head.placement,
        isFlipped
      )
      if isOpen then form.culled(in) else form

  /** Tubes; or pbrt's curves, if there are many. Light that is transmitted does not meet the far
    * side of either.
    */
  private def ofHair(in: Properties): Vector[Form] =
    in.ignore("flip_normals")
    val curves = read(in, 4).toVector.flatten
    if curves.map(_.points.size - 3).sum <= Shapes.MaxRoundHair then
      curves.headOption.toVector.map: first =>
        val mesh = params(Tubes.splines(curves), in)
        Form("trianglemesh", mesh, first.placement, isReversed = false).culled(in)
    else
      for curve <- curves; fibre <- Fibres.of(curve)
      yield Form("curve", fibre.params(in.pos), curve.placement, isReversed = false)

  private def meshForm(
      in: Properties,
      isFlipped: Boolean,
      toWorld: Transform,
      attributes: Option[MeshAttributes] = None
  ): Mesh => Form =
    val isFaceted = in.flag("face_normals", false)
    val smoothAngle = in.number("max_smooth_angle").filter(_ => !isFaceted && attributes.isEmpty)
    mesh =>
      val inWorld = mesh.placed(toWorld)
      val withNormals = smoothAngle match
        case Some(degrees) => inWorld.smoothBelow(degrees)
        case None => if isFaceted then inWorld.faceted else inWorld.smooth
      val laid = attributes.fold(withNormals)(_.laidOut(withNormals))
      val shaded = if in.nested("bsdf").headOption.exists(isMapped) then laid.onTriangles else laid
      Form("trianglemesh", params(shaded, in), Transform.Identity, isFlipped)

  /** Does the look of the surface depend on u and v? */
  private def isMapped(bsdf: Plugin): Boolean =
    surfaces.textureTypes(bsdf).exists(Set("bitmap", "checkerboard", "gridtexture"))

  private def params(m: Mesh, in: Properties): Seq[Param] =
    val uvs = m.uvs.clone
    loop(uvs.length / 2)(i => uvs(2 * i + 1) = 1 - uvs(2 * i + 1))
    Seq(
      Param.int("indices", in.pos, m.indices*),
      Param.floats(ParamType.Point3, "P", in.pos, m.positions, m.rests)
    ) ++
      Option.when(m.normals.nonEmpty)(Param.floats(ParamType.Normal, "N", in.pos, m.normals)) ++
      Option.when(uvs.nonEmpty)(Param.floats(ParamType.Point2, "uv", in.pos, uvs))

object Shapes:
  /** Segments of hair that become tubes: with more, tubes are coarser. */
  private val MaxRoundHair = 1000

  /** A frame about a unit vector.
    *
    * Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    */
  def frame(x: Double, y: Double, z: Double): Transform =
    val sign = if z < 0 then -1.0 else 1.0
    val a = -1 / (sign + z)
    val b = x * y * a
    Transform.fromRows(Vector(
      1 + sign * x * x * a,
      b,
      x,
      0,
      sign * b,
      sign + y * y * a,
      y,
      0,
      -sign * x,
      -y,
      z,
      0,
      0,
      0,
      0,
      1
    )).get
