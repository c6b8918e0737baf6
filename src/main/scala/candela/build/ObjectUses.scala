package candela.build

import scala.collection.mutable.ArrayBuffer

import candela.base.Suggest
import candela.build.recipe.*
import candela.math.{Motion, MotionProduct}
import candela.scenefile.*

/** An object, and where it stands or how it moves. */
final case class PlacedObject(shapes: Vector[ShapeDescription], places: Vector[Motion])

/** Decides which shapes are the world's own, and which are objects that instances place in it:
  *
  *   - An object that stands in one place only is cheaper to trace among the world's surfaces, and
  *     needs no more memory there: it is copied. So are objects seen through perspective maps,
  *     which no instance can have.
  *   - A shape that moves is an object; within an object, it is one of its own wherever that
  *     stands.
  *
  * No instance emits light and nothing that moves does, as in pbrt (which warns of it, too; pbrt-v4
  * refuses moving lamps).
  */
private[build] final class ObjectUses(description: SceneDescription, problems: Findings):
  private val motions = Motions(description)
  private val own = ArrayBuffer.empty[ShapeDescription]
  private val objects = ArrayBuffer.empty[PlacedObject]

  for s <- description.shapes do
    if Motions.moves(s.objectToWorld) then
      val dark = withoutLight(s, "a moving shape emits no light: area lights can't move")
      objects += PlacedObject(Vector(atOrigin(dark)), Vector(motions.of(s.objectToWorld)))
    else
      if s.objectToWorld.isAnimated then
        problems.warn(s.shape.at, Motions.stands("what is seen through a perspective map"))
      own += s

  for (name, uses) <- description.instances.groupBy(_.name).toVector.sortBy(_._1) do
    description.objects.get(name) match
      case None =>
        for use <- uses do
          problems.unnamed(
            NameKind.Object,
            use.at,
            s"no object is named `$name`",
            StandIns.LeftOut,
            Suggest.help(name, description.objects.keys)
          )
      case Some(shapes) =>
        val message = "a shape in an object emits no light: area lights can't be instanced"
        place(shapes.map(withoutLight(_, message)), uses)

  /** Shapes of the world, copies of objects among them. */
  def world: Vector[ShapeDescription] = own.toVector

  /** Objects that stand in several places, or move. */
  def shared: Vector[PlacedObject] = objects.toVector

  private def place(shapes: Vector[ShapeDescription], uses: Vector[InstanceDescription]): Unit =
    val (affine, seen) = uses.partition(u => Motions.isAffine(u.instanceToWorld))
    for u <- seen do
      if u.instanceToWorld.isAnimated || shapes.exists(s => Motions.moves(s.objectToWorld)) then
        problems.warn(u.at, Motions.stands("what is seen through a perspective map"))
      own ++= shapes.map(copied(_, u))
    val (moving, still) = shapes.partition(s => Motions.moves(s.objectToWorld))
    val isAlone = uses.length == 1 && !uses.head.instanceToWorld.isAnimated
    val places = affine.map(u => motions.ofInstance(u.instanceToWorld))
    if isAlone then own ++= affine.flatMap(u => still.map(copied(_, u)))
    else if still.nonEmpty && places.nonEmpty then objects += PlacedObject(still, places)
    if places.nonEmpty then
      for s <- moving do
        val within = motions.of(s.objectToWorld)
        objects += PlacedObject(Vector(atOrigin(s)), places.map(MotionProduct(_, within)))

  private def withoutLight(s: ShapeDescription, message: String): ShapeDescription =
    for light <- s.areaLight do problems.warn(light.at, message)
    s.copy(areaLight = None)

  private def atOrigin(s: ShapeDescription): ShapeDescription =
    s.copy(objectToWorld = GraphicsState.Identity)

  private def copied(s: ShapeDescription, use: InstanceDescription): ShapeDescription =
    val toWorld = use.instanceToWorld.start * s.objectToWorld.start
    s.copy(objectToWorld = GraphicsState.still(toWorld))
