package candela.build

import candela.diagnostics.{Code, Suggest}
import scala.collection.IndexedSeqView
import scala.collection.mutable.{ArrayBuffer, HashSet}

import candela.build.recipe.*
import candela.math.{Motion, MotionProduct, Position, RecentredMotion}
import candela.scenefile.*

/** An object and the motions of its instances.
  *
  * @param places are made when they are asked for, as there may be millions, unless they are
  *   animated
  * @param name   of the object; empty for an animated shape, which is one
  * @param plain  how many of the places are rows of the description, which instances share
  */
final case class PlacedObject(
    shapes: Vector[ShapeDescription],
    places: IndexedSeqView[Motion],
    name: String = "",
    plain: Int = 0
)

/** Splits shapes into those of the world and objects that are instanced:
  *
  *   - An object with one static instance is copied to the world: it is faster to trace there and
  *     needs no more memory. Objects under perspective transforms are also copied, because
  *     instances don't support these.
  *   - An animated shape is an object; within an object, it is a separate object for each instance.
  *
  * Animated shapes can't emit light, as in pbrt (which also warns; pbrt-v4 rejects animated area
  * lights), nor can instances in v4. In v2 and v3 the area lights of instances are seen, directly
  * and by specular scattering, but light nothing.
  */
private[build] final class ObjectUses(
    description: SceneDescription,
    origin: Position,
    problems: Findings
):
  private val motions = Motions(description, origin)
  private val worldShapes = Vector.newBuilder[ShapeDescription]
  private val objects = ArrayBuffer.empty[PlacedObject]

  // Those of most scenes are taken as they are: there may be millions
  private val isStill = !description.shapes.exists(_.objectToWorld.isAnimated)
  if isStill then worldShapes ++= description.shapes
  for s <- description.shapes if !isStill do
    if Motions.moves(s.objectToWorld) then
      motions.warnOfMirror(s.objectToWorld, s.shape.pos, problems)
      val dark = withoutLight(s, "animated shapes can't be area lights; emission is ignored")
      objects += placed(Vector(atOrigin(dark)), Vector(motions.of(s.objectToWorld)).view)
    else
      if s.objectToWorld.isAnimated then
        problems.warn(
          Code.NotAnimated,
          s.shape.pos,
          Motions.notAnimated("a shape under a perspective transform")
        )
      worldShapes += s

  private val placedNames = HashSet.empty[String]
  for (name, uses) <- description.instances.ofEach do
    placedNames += name
    description.objects.get(name) match
      case None =>
        for use <- uses do
          problems.unnamed(
            Code.Undefined,
            NameKind.Object,
            use.pos,
            s"object `$name` is not defined",
            StandIns.LeftOut,
            Suggest.help(name, description.objects.keys)
          )
      case Some(shapes) =>
        addInstances(name, shapes.map(ofObject), uses)

  /** Shapes of the world, including copied objects. */
  val world: Vector[ShapeDescription] = worldShapes.result()

  /** Shapes of objects without instances. */
  def unplaced: Vector[ShapeDescription] =
    description.objects.iterator.filterNot((name, _) => placedNames(name)).flatMap(_._2).toVector

  /** Objects with several or animated instances. */
  def shared: Vector[PlacedObject] = objects.toVector

  private def addInstances(
      name: String,
      shapes: Vector[ShapeDescription],
      uses: InstanceList
  ): Unit =
    val plain = uses.plain
    val (affine, seen) =
      if plain == uses.length then (uses, InstanceList.Empty)
      else uses.partition(u => Motions.isAffine(u.instanceToWorld))
    for u <- seen do
      if u.instanceToWorld.isAnimated || shapes.exists(s => Motions.moves(s.objectToWorld)) then
        problems.warn(
          Code.NotAnimated,
          u.pos,
          Motions.notAnimated("a shape under a perspective transform")
        )
      worldShapes ++= shapes.map(copied(_, u))
    val (moving, still) = shapes.partition(s => Motions.moves(s.objectToWorld))
    for s <- moving do motions.warnOfMirror(s.objectToWorld, s.shape.pos, problems)
    if plain < uses.length then
      for u <- affine if u.instanceToWorld.isAnimated do
        motions.warnOfMirror(u.instanceToWorld, u.pos, problems)
    val isAlone = uses.length == 1 && !uses.head.instanceToWorld.isAnimated
    val instanceMotions = affine.motions(motions.ofInstance)
    if isAlone then worldShapes ++= affine.flatMap(u => still.map(copied(_, u)))
    else if still.nonEmpty && instanceMotions.nonEmpty then
      objects += placed(still, instanceMotions, name, plain)
    if instanceMotions.nonEmpty then
      for s <- moving do
        val shapeMotion = motions.inObject(s.objectToWorld)
        objects += placed(Vector(atOrigin(s)), instanceMotions.map(MotionProduct(_, shapeMotion)))

  /** An object whose shapes are far from its origin is built around another. */
  private def placed(
      shapes: Vector[ShapeDescription],
      places: IndexedSeqView[Motion],
      name: String = "",
      plain: Int = 0
  ): PlacedObject =
    val middle = RenderOrigin.ofObject(shapes, looks = !origin.isOrigin)
    if middle.isOrigin then PlacedObject(shapes, places, name, plain)
    else
      def moved(s: ShapeDescription) =
        s.copy(objectToWorld = GraphicsState.constant(middle.toOrigin * s.objectToWorld.start))
      val recentred = places.map(RecentredMotion(_, middle, Position.Origin))
      PlacedObject(shapes.map(moved), recentred, name)

  private def ofObject(s: ShapeDescription): ShapeDescription =
    if description.dialect.base == Dialect.V4 then
      withoutLight(s, "shapes of an object can't be area lights; emission is ignored")
    else if s.areaLight.isDefined && Motions.moves(s.objectToWorld) then
      withoutLight(s, "animated shapes can't be area lights; emission is ignored")
    else
      for light <- s.areaLight do
        problems.warn(
          Code.AsInPbrt,
          light.pos,
          "area lights of an object are seen, but light nothing, as in pbrt",
          Some("place the light outside of the object")
        )
      s.copy(inObject = true)

  private def withoutLight(s: ShapeDescription, message: String): ShapeDescription =
    for light <- s.areaLight do problems.warn(Code.AsInPbrt, light.pos, message)
    s.copy(areaLight = None)

  private def atOrigin(s: ShapeDescription): ShapeDescription =
    s.copy(objectToWorld = GraphicsState.Identity)

  private def copied(s: ShapeDescription, use: InstanceDescription): ShapeDescription =
    val toWorld = use.instanceToWorld.start * s.objectToWorld.start
    val instance = Some(use.instanceToWorld.start).filterNot(_.isFlat)
    s.copy(objectToWorld = GraphicsState.constant(toWorld), copied = instance)
