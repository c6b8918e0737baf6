package candela.build

import candela.base.{IntBuffer, loop}
import candela.diagnostics.Code
import scala.collection.mutable.ArrayBuffer

import candela.accel.{MaskColumn, Masks, SolidMask}
import candela.build.integrators.IntegratorPlan
import candela.build.lights.{AreaLightPlan, MeshLights, ScaledLight, UniformScale}
import candela.build.recipe.*
import candela.build.shapes.{
  EmitterHoles, FarPoints, Rectangles, ShapeGeometry, ShapePlan, Shapes, SoupBuilder, UvSides
}
import candela.lights.{Light, ShownLight, SurfaceLight}
import candela.math.Transform
import candela.scene.{ShapeRows, ShapeTable, Surfaces}
import candela.scenefile.{Declaration, Dialect}
import candela.shapes.{BumpTangents, Shape, TriangleSoup}

/** A light, its number of samples in v2's and v3's direct lighting, and its statement. */
private[build] final case class SampledLight(light: Light, samples: Int, statement: Declaration)

/** Surfaces and their area lights, in the order of their indices.
  *
  * @param stated     statements of the meshes, then of the other shapes
  * @param lit        makes the lights, in the colour basis of a context
  */
private[build] final class LitSurfaces(
    val surfaces: Surfaces,
    stated: () => Vector[Declaration],
    lit: BuildContext => Vector[SampledLight]
):
  def statements: Vector[Declaration] = stated()
  def lights(context: BuildContext): Vector[SampledLight] = lit(context)

/** Collects the surfaces of the world or of an instanced object.
  *
  * @param integrator decides what the openings of masks are
  * @param firstLight index of its first area light
  */
private[build] final class SurfaceBuilder(
    context: BuildContext,
    materials: MaterialTable,
    integrator: IntegratorPlan,
    firstLight: Int = 0
):
  private val soup = SoupBuilder()
  private val solids = ShapeRows(context.resources.pool)
  private val meshMasks, solidMasks, meshVeils, solidVeils = MaskColumn()
  private val meshStatements = ArrayBuffer.empty[Declaration]

  /** The statements of solids; each with the number of the first solid after its own. */
  private val solidStatements = ArrayBuffer.empty[Declaration]
  private val endsOfStatements = IntBuffer()

  /** Creates the area lights from all triangles, in the order of their indices. */
  private val lights = ArrayBuffer.empty[(BuildContext, TriangleSoup) => Vector[SampledLight]]
  private var lightCount = firstLight

  /** Index after that of the last area light. */
  def endOfLights: Int = lightCount

  /** The first surface that stops light samples, though paths pass it. */
  var shadowing: Option[Declaration] = None

  /** @param triangles of each light; each has its samples in v2's and v3's direct lighting */
  private def addLights(
      count: Int,
      statement: Declaration,
      isShownOnly: Boolean,
      triangles: Int = 1
  )(
      make: (AreaLightPlan, TriangleSoup) => Vector[Light]
  ): Unit =
    lights += { (context, soup) =>
      context.emission(statement).toVector.flatMap: plan =>
        for light <- make(plan, soup) yield
          val wrapped = light match
            case s: SurfaceLight if isShownOnly => ShownLight(s)
            case other => other
          SampledLight(wrapped, plan.samples * triangles, statement)
    }
    lightCount += count

  def add(dressed: DressedShape): Unit =
    context.resources.allowance.checkTime(Some(dressed.declared.pos))
    val written = dressed.shape.objectToWorld.start
    val (declared, toWorld) = FarPoints.recentred(dressed.declared, written) match
      case Some((near, origin)) => (near, written * origin.fromOrigin)
      case None => (dressed.declared, written)
    val site = context.site(declared, toWorld)
    for plan <- alike(declared, isPlaced, throughOthers)(Shapes.all.build(site).flatten) do
      val emitter = dressed.shape.areaLight.filter(context.emission(_).isDefined)
        .filter(_ => !isUnlit(dressed.material, site))
      val countBefore = soup.triangleCount + solids.count
      Placement(dressed, site, plan, emitter, toWorld).insert(plan.geometry)
      val added = soup.triangleCount + solids.count - countBefore
      context.resources.allowance.countShapes(added, Some(declared.pos))

  private val alike = Alike[Option[ShapePlan]](context.problems)

  /** Is the plan the same wherever the shape is? */
  private def isPlaced(plan: Option[ShapePlan]): Boolean = plan.map(_.geometry) match
    case Some(ShapeGeometry.Solid(_, _)) => true
    case _ => false

  /** The plan of curves through other points. */
  private def throughOthers(
      plan: Option[ShapePlan]
  ): Option[Array[Float] => Option[Option[ShapePlan]]] =
    plan.map(_.geometry) match
      case Some(ShapeGeometry.Curves(strand, _)) =>
        Some: p =>
          strand.through(p).map: curves =>
            plan.map(_.copy(geometry = ShapeGeometry.Curves(strand, curves)))
      case _ => None

  private def isUnlit(material: Int, site: Site): Boolean =
    val isDark = !context.rules.glows && materials.materials(material).isInterface
    if isDark then
      site.warn(Code.DarkLight, "a shape of material \"interface\" gives no light, as in pbrt-v4")
    isDark

  def result(): LitSurfaces =
    val triangles = soup.result(materials.needsTangents, context.resources.hasRelief)
    val masks = Masks.of(meshMasks, solidMasks)
    val veils = Masks.of(meshVeils, solidVeils)
    LitSurfaces(
      Surfaces(triangles, solids.result(), masks, veils),
      () => statements,
      context => lights.iterator.flatMap(_(context, triangles)).toVector
    )

  /** Of the meshes, then of each solid. */
  private def statements: Vector[Declaration] =
    val builder = Vector.newBuilder[Declaration].addAll(meshStatements)
    var first = 0
    for i <- solidStatements.indices do
      loop(endsOfStatements(i) - first)(_ => builder += solidStatements(i))
      first = endsOfStatements(i)
    builder.result()

  /** A shape being placed in the world. */
  private final class Placement(
      dressed: DressedShape,
      site: Site,
      plan: ShapePlan,
      emitter: Option[Declaration],
      toWorld: Transform
  ):
    private val isReversed = dressed.shape.reverseOrientation
    private val (mask, veil) =
      if integrator.hasVeils || isBorder then plan.mask.veiled else (plan.mask, SolidMask)
    private val holes = if veil eq SolidMask then plan.holes else EmitterHoles.Ignored
    if isShadowing then shadowing = shadowing.orElse(Some(dressed.declared))

    /** Are openings of the mask borders of media, too? In pbrt there is no surface there, and those
      * of emitters do not emit.
      */
    private def isBorder: Boolean =
      val border = materials.borders(dressed.material)
      border.inside != border.outside && emitter.isEmpty && Dialect.ofOthers(context.rules.dialect)

    /** Does the surface stop light samples, though paths pass it? */
    private def isShadowing: Boolean = integrator.interfaces.stopsLight &&
      ((veil ne SolidMask) || materials.materials(dressed.material).isInterface)

    /** In Mitsuba's scenes, samples of an emitter lie on the side that rays see. */
    private val isConsistent = context.rules.facesEmitters

    def insert(geometry: ShapeGeometry): Unit = geometry match
      case mesh: ShapeGeometry.Triangles if context.isV2 && emitter.isDefined =>
        for (sides, isTurned) <- UvSides.of(mesh) do addMesh(sides, isTurned)
      case mesh: ShapeGeometry.Triangles => addMesh(mesh, isTurned = false)
      case ShapeGeometry.Solid(_, _) if toWorld.isFlat => () // reported before
      case ShapeGeometry.Solid(make, turned) =>
        if emitter.isDefined && !dressed.shape.inObject then
          warnOfMissingPart()
          ScaledLight.warn(sinceV3, UniformScale.isOne, "samples it without the scale")(using site)
        val facesInwards = isReversed != (isConsistent && isReflected)
        // Samples of a mirrored emitter that is a cylinder lie on its other side, as in Mitsuba
        val isOdd = isConsistent && isReflected && emitter.isDefined &&
          dressed.declared.name == "cylinder"
        addSolid(make(toWorld, facesInwards != isOdd), emitter, (isInverted != turned) != isOdd)
      case ShapeGeometry.Solids(make) =>
        for shape <- make(toWorld, isReversed) do addSolid(shape, emitter, isInverted = false)
      case ShapeGeometry.Curves(strand, curves) =>
        if emitter.isDefined then
          val name = dressed.shape.shape.name
          site.warn(
            Code.DarkLight,
            s"a \"$name\" can't be an area light, as in pbrt; emission is ignored"
          )
        note(solids.addCurves(curves, strand.form, toWorld, isReversed, dressed.material))
      case ShapeGeometry.Several(parts) => parts.foreach(insert)
      case ShapeGeometry.Around(origin, parts) =>
        Placement(dressed, site, plan, emitter, toWorld * origin.fromOrigin).insert(parts)

    /** pbrt-v3 and v4 flip the normals of reflected quadrics, v2 those of all disks. */
    private def isInverted: Boolean =
      if context.isV2 then dressed.declared.name == "disk"
      else !isConsistent && isReflected

    /** pbrt samples whole spheres, also those of which only a part emits. */
    private def warnOfMissingPart(): Unit =
      val d = dressed.declared
      def number(name: String, default: Float) =
        d.param(name).flatMap(_.floats.headOption).getOrElse(default)
      val radius = Math.abs(number("radius", 1f))
      val ends = Seq(number("zmin", -radius), number("zmax", radius))
      val isWhole = ends.min <= -radius && ends.max >= radius && number("phimax", 360f) >= 360f
      if d.name == "sphere" && !isWhole && every(context.dialect) then
        site.warn(
          Code.UnlikePbrt,
          "pbrt samples the light of this sphere on its missing part, too; how bright it makes " +
            "what is near differs from pbrt's image"
        )

    /** Is the shape mirrored where it is defined? Instances keep the outside of their objects. */
    private def isReflected: Boolean =
      toWorld.swapsHandedness != dressed.shape.copied.exists(_.swapsHandedness)

    private def addSolid(
        shape: Shape,
        emitter: Option[Declaration],
        isInverted: Boolean
    ): Unit =
      val lit = emitter.filter(_ => hasArea(shape))
      val light = lit.fold(ShapeTable.Dark)(_ => lightCount)
      for emitter <- lit do
        addLights(1, emitter, dressed.shape.inObject): (emitted, _) =>
          Vector(holes.light(emitted.ofShape(shape, isInverted), shape))
      solids.add(shape, dressed.material, light, isInverted)
      note(1)

    /** Notes what the last solids share. */
    private def note(count: Int): Unit =
      solidMasks.add(mask, count)
      solidVeils.add(veil, count)
      solidStatements += dressed.declared
      endsOfStatements += solids.count

    private def hasArea(shape: Shape): Boolean =
      val isFinite = java.lang.Float.isFinite(shape.area)
      if !isFinite then
        site.warn(
          Code.DarkLight,
          "the area of this area light is too large for a number; it is ignored"
        )
      else if shape.area <= 0f then
        site.warn(Code.DarkLight, "this area light has no area; it is ignored")
      isFinite && shape.area > 0f

    /** @param isTurned do rays see the other sides? */
    private def addMesh(mesh: ShapeGeometry.Triangles, isTurned: Boolean): Unit =
      val count = mesh.indices.length / 3
      val limit = SurfaceBuilder.MaxTriangles
      if soup.triangleCount.toLong + count > limit then
        site.error(Code.TooLarge, s"more than $limit triangles in the world or in one object")
      else
        val light = emitter.fold(-1)(_ => lightCount)
        val flipNormals = !context.isV2
        val contrary = isContrary(mesh) != isTurned
        val corners = emitter
          .filter(isUniform(_) && !contrary)
          .fold(Vector.empty)(_ => Rectangles.of(mesh, toWorld))
        val isPaired = corners.nonEmpty
        val readsPartials = emitter.isDefined || !materials.materials(dressed.material).isConstant
        val first = soup.add(
          mesh,
          toWorld,
          isReversed,
          flipNormals,
          isTurned,
          dressed.material,
          light,
          bumps,
          isPaired,
          readsPartials,
          facesFacet = context.isV2 && emitter.isDefined,
          turned = context.dialect == Dialect.V3 && materials.materials(dressed.material).isDirected
        )
        meshMasks.add(mask)
        meshVeils.add(veil)
        meshStatements += dressed.declared
        val isShownOnly = dressed.shape.inObject
        for emitter <- emitter do
          if contrary then warnOfSides(emitter)
          if isPaired then
            addLights(
              corners.size,
              emitter,
              isShownOnly,
              2
            )(MeshLights.ofRectangles(first, corners).of)
          else
            addLights(count, emitter, isShownOnly)(
              MeshLights.ofTriangles(holes, first, count, contrary, site).of
            )

    /** Both programs weigh the two estimates of this light as if they saw the same. */
    private def warnOfSides(emitter: Declaration): Unit =
      if !emitter.param("twosided").exists(_.bools.contains(true)) then
        site.warn(
          Code.UnlikePbrt,
          "this light is seen on one side and lights the other, as in pbrt; how bright it makes " +
            "what is near depends on how it is sampled, and differs from pbrt's image"
        )

    /** pbrt-v3 turns a reversed mesh with normals over for rays only, pbrt-v2 a mirrored one. */
    private def isContrary(mesh: ShapeGeometry.Triangles): Boolean = context.dialect match
      case Dialect.V3 => isReversed && mesh.normals.nonEmpty
      case Dialect.V2 => toWorld.swapsHandedness
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf => false

    private def isUniform(emitter: Declaration): Boolean =
      holes == EmitterHoles.Ignored && context.emission(emitter).exists(_.isUniform)

    private def bumps: BumpTangents = context.dialect match
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf =>
        val skews = dressed.shape.copied.filter(_.uniformScale.isEmpty)
        BumpTangents.Along.copy(within = skews.orNull)
      case Dialect.V2 => BumpTangents.ofV2(isReversed != toWorld.swapsHandedness)
      case Dialect.V3 =>
        def isRigid(t: Transform) = t.uniformScale.exists(s => Math.abs(s - 1) <= 1e-5)
        val scales = dressed.shape.copied.filterNot(isRigid)
        BumpTangents.Turned.copy(bendsBack = isReversed, within = scales.orNull)

private[build] object SurfaceBuilder:
  /** 9 Floats per triangle must fit into one array. */
  val MaxTriangles = 200_000_000
