package candela.build.media

import candela.diagnostics.{Code, Problem, SourcePos}
import candela.geometry.{Bounds3, BoxTree}
import candela.math.{Transform, Vec3}
import candela.scenefile.{Dialect, SceneDescription, ShapeDescription}

import scala.collection.mutable

/** What the media of a model fill: meshes, and the boxes of grids. */
final class Interiors private (scene: SceneDescription):
  private val grids = scene.media.filter(_.medium.name == "nanovdb").map(_.name).toSet
  private val problems = mutable.LinkedHashSet.empty[Problem]

  private def warn(at: SourcePos, message: String): Unit =
    problems += Problem.warning(Code.Unsupported, at, message)

  /** Primitives that are closed only together are one mesh. */
  private def filled(shapes: Vector[ShapeDescription]): Vector[FilledRegion] =
    val parts =
      for (s, i) <- shapes.zipWithIndex if s.insideMedium.nonEmpty
      yield (i, FilledMesh(Vector(s.shape)))
    def region(mesh: FilledMesh, members: Vector[Int]) =
      val first = shapes(members.head)
      val medium = first.insideMedium
      FilledRegion(medium, mesh, first.objectToWorld.start, grids(medium), members)
    val (open, closed) = parts.partition(_._2.isOpen)
    val joined = open.map(_._1).groupBy(i => (shapes(i).insideMedium, shapes(i).objectToWorld))
    val together =
      joined.values.map(members => region(FilledMesh(members.map(shapes(_).shape)), members))
    (closed.map((i, mesh) => region(mesh, Vector(i))) ++ together).sortBy(_.members.head)

  private val single = filled(scene.shapes)
  private val inObjects =
    scene.objects.map((name, shapes) => name -> filled(shapes)).filter(_._2.nonEmpty)

  /** All in the world. */
  private val interiors: Vector[FilledRegion] =
    val instances =
      if inObjects.isEmpty then Iterator.empty
      else
        for
          (i, number) <- scene.instances.iterator.zipWithIndex
          interior <- inObjects.getOrElse(i.name, Vector.empty)
        yield interior.copy(
          toWorld = i.instanceToWorld.start * interior.toWorld,
          instance = number
        )
    single ++ instances

  /** The scene in which media end where others begin. */
  private def bordered: SceneDescription =
    for
      mesh <- (single ++ inObjects.values.flatten).iterator.map(_.mesh)
      flaw <- mesh.flaw
    do warn(mesh.at, flaw)
    def withBorders(shapes: Vector[ShapeDescription], all: Vector[FilledRegion]) =
      val outside = media(all)
      shapes.zipWithIndex.map((s, i) => outside.get(i).fold(s)(m => s.copy(outsideMedium = m)))
    val objects = scene.objects.map: (name, shapes) =>
      name -> inObjects.get(name).fold(shapes)(withBorders(shapes, _))
    scene.copy(shapes = withBorders(scene.shapes, interiors), objects = objects)

  /** The medium around each shape that has no instances and lies within others. */
  private def media(all: Vector[FilledRegion]): Map[Int, String] =
    val tree = BoxTree(all.size, all(_).bounds)
    // The first of a kind, of which there may be millions
    val crossing = mutable.LinkedHashMap.empty[Boolean, SourcePos]
    val surrounding =
      for
        (inner, i) <- all.iterator.zipWithIndex
        outer <- innermost(inner, i, all, tree, crossing).toVector
        member <- inner.members
      yield member -> outer.medium
    val result = surrounding.toMap
    for (areGrids, at) <- crossing do
      val message =
        if areGrids then "the boxes of two media overlap or touch; there, only one of them is seen"
        else "this mesh meets another medium, which may not be seen behind it"
      warn(at, message)
    result

  private def innermost(
      inner: FilledRegion,
      number: Int,
      all: Vector[FilledRegion],
      tree: BoxTree,
      crossing: mutable.Map[Boolean, SourcePos]
  ): Option[FilledRegion] =
    var closest = Option.empty[FilledRegion]
    tree.forEach(inner.bounds): j =>
      val outer = all(j)
      val isSameInstance = inner.isShared && inner.instance == outer.instance
      val isLarger = outer.size > inner.size || outer.size == inner.size && j > number
      if isLarger && !isSameInstance then
        val placement = outer.placement(inner)
        if placement == FilledMesh.Placement.Inside && !inner.isShared then
          if closest.forall(_.size > outer.size) then closest = Some(outer)
        else if placement != FilledMesh.Placement.Outside then
          val named = if inner.isGrid then outer else inner
          crossing.getOrElseUpdate(inner.isGrid && outer.isGrid, named.mesh.at): Unit
    closest

  private def withCamera: SceneDescription =
    val toWorld = scene.worldToCamera.start.inverse
    val startMedia = RayStarts(scene).map(p => mediumAt(toWorld.point(p)))
    for camera <- scene.camera if startMedia.distinct.size > 1 do
      val message = "rays of this camera begin in several media; using that of the middle for all"
      warn(camera.pos, message)
    scene.copy(cameraMedium = startMedia.headOption.getOrElse(""))

  /** The innermost medium at a point; empty: none. */
  private def mediumAt(p: Vec3): String =
    interiors.filter(_.contains(p)).minByOption(_.size).fold("")(_.medium)

object Interiors:
  /** The model in which media end where others begin, and what may be wrong with them. */
  def bordered(scene: SceneDescription): (SceneDescription, Vector[Problem]) =
    if scene.media.isEmpty then (scene, Vector.empty)
    else
      val run = Interiors(scene)
      (run.bordered, run.problems.toVector)

  /** The model with the medium around its camera; other scenes say it themselves. */
  def aroundCamera(scene: SceneDescription): SceneDescription =
    if scene.dialect != Dialect.Gltf || scene.media.isEmpty then scene
    else
      val run = Interiors(scene)
      val placed = run.withCamera
      placed.copy(warnings = placed.warnings ++ run.problems)

/** A mesh that a medium fills.
  *
  * @param isGrid   whether it is the box of a grid
  * @param members  the indices of its shapes among those of the scene or the object
  * @param instance number of the instance that it belongs to; −1: none
  */
private final case class FilledRegion(
    medium: String,
    mesh: FilledMesh,
    toWorld: Transform,
    isGrid: Boolean,
    members: Vector[Int],
    instance: Int = -1
):
  /** In the world, with what surfaces must be apart to be told apart. */
  val bounds: Bounds3 =
    val tight = mesh.bounds.mapped(toWorld.point)
    tight.grown(FilledRegion.margin(tight))

  val size: Float = bounds.radius

  def isShared: Boolean = instance >= 0

  def contains(p: Vec3): Boolean =
    bounds.union(p) == bounds && !toWorld.isFlat && mesh.contains(toWorld.inverse.point(p))

  /** Where another is whose bounds meet those of this one. */
  def placement(inner: FilledRegion): FilledMesh.Placement =
    if isGrid && inner.isGrid || toWorld.isFlat then FilledMesh.Placement.Across
    else
      mesh.placement(inner.mesh, toWorld.inverse * inner.toWorld, FilledRegion.margin(mesh.bounds))

private object FilledRegion:
  /** More than the rounding errors of intersections, of the coordinates. */
  private val Margin = 1e-5f

  private def margin(bounds: Bounds3): Float =
    val reach = bounds.reach
    Margin * Math.max(reach.x, Math.max(reach.y, reach.z))
