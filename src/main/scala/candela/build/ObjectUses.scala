package candela.build

import scala.collection.mutable.ArrayBuffer

import candela.base.Suggest
import candela.math.Transform
import candela.scenefile.*

/** An object, and where it stands. */
final case class PlacedObject(shapes: Vector[ShapeDescription], places: Vector[Transform])

/** Decides which instances share their object's surfaces, and which are copies: an object that
  * stands in one place only is cheaper to trace among the world's surfaces, and needs no more
  * memory there. So do perspective maps, which no instance can have.
  *
  * No instance emits light, as in pbrt (which says so in a warning, too).
  */
private[build] final class ObjectUses(description: SceneDescription, problems: Findings):
  private val copies = ArrayBuffer.empty[ShapeDescription]
  private val objects = ArrayBuffer.empty[PlacedObject]

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
        val dark = shapes.map(withoutLight)
        val (placed, copied) = uses.partition(u => uses.length > 1 && isAffine(u))
        for u <- copied do copies ++= dark.map(moved(_, u.instanceToWorld))
        if placed.nonEmpty && dark.nonEmpty then
          for u <- placed if u.instanceToWorld.isAnimated do
            problems.warn(u.at, SceneBuilder.Motion)
          objects += PlacedObject(dark, placed.map(_.instanceToWorld.start))

  /** Shapes of the world that stand for an instance. */
  def copied: Vector[ShapeDescription] = copies.toVector

  /** Objects that stand in several places. */
  def shared: Vector[PlacedObject] = objects.toVector

  private def withoutLight(s: ShapeDescription): ShapeDescription =
    for light <- s.areaLight do
      problems.warn(light.at, "a shape in an object emits no light: area lights can't be instanced")
    s.copy(areaLight = None)

  private def moved(s: ShapeDescription, t: AnimatedTransform): ShapeDescription =
    val toWorld = AnimatedTransform(t.start * s.objectToWorld.start, t.end * s.objectToWorld.end)
    s.copy(objectToWorld = toWorld)

  private def isAffine(i: InstanceDescription): Boolean =
    val AnimatedTransform(start, end) = i.instanceToWorld
    start.isAffine && end.isAffine && !start.isFlat && !end.isFlat
