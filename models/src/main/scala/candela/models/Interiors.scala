package candela.models

import candela.base.loop
import candela.geometry.Bounds3
import candela.math.{Transform, Vec3}
import candela.scenefile.{Declaration, SceneDescription, ShapeDescription}

import scala.collection.mutable

/** What the media of a model fill: meshes, and the boxes of grids. */
private[models] final class Interiors(scene: SceneDescription, session: Session):
  private val grids = scene.media.filter(_.medium.name == "nanovdb").map(_.name).toSet

  private def filled(shapes: Vector[ShapeDescription]): Vector[Interior] =
    val parts = mutable.LinkedHashMap.empty[(String, Transform), Vector[Declaration]]
    for s <- shapes if s.insideMedium.nonEmpty do
      parts.updateWith(key(s))(before => Some(before.getOrElse(Vector.empty) :+ s.shape)): Unit
    parts.map { case ((medium, toWorld), all) =>
      Interior(medium, FilledMesh(all), toWorld, grids(medium), isShared = false)
    }.toVector

  private def key(s: ShapeDescription) = (s.insideMedium, s.objectToWorld.start)

  private val interiors: Vector[Interior] =
    val objects = scene.objects.map((name, shapes) => name -> filled(shapes))
    val instances =
      if objects.values.forall(_.isEmpty) then Iterator.empty
      else
        for i <- scene.instances.iterator; interior <- objects.getOrElse(i.name, Vector.empty)
        yield interior.copy(toWorld = i.instanceToWorld.start, isShared = true)
    filled(scene.shapes) ++ instances

  /** The scene in which media end where others begin, and with the medium around its camera. */
  def result: SceneDescription =
    if interiors.isEmpty then scene
    else
      for mesh <- interiors.iterator.map(_.mesh).distinct if mesh.isOpen do
        session.warn(
          mesh.at,
          "this mesh is not closed: rays may enter its medium and never leave it"
        )
      val surrounding = mutable.HashMap.empty[(String, Transform), String]
      // The first box and the first mesh, of which there may be millions
      val crossing = mutable.LinkedHashMap.empty[Boolean, FilledMesh]
      for (box, inner) <- meetings do
        if box.surrounds(inner) then surrounding((inner.medium, inner.toWorld)) = box.medium
        else crossing.getOrElseUpdate(inner.isGrid, inner.mesh): Unit
      for (isGrid, mesh) <- crossing do
        val message =
          if isGrid then "the boxes of two media overlap or touch; there, only one of them is seen"
          else "this mesh meets the box of another medium, which may not be seen behind it"
        session.warn(mesh.at, message)
      withCamera(scene.copy(shapes = scene.shapes.map: s =>
        surrounding.get(key(s)).fold(s)(around => s.copy(outsideMedium = around))))

  /** Boxes, and what overlaps or touches them. */
  private def meetings: Iterator[(Interior, Interior)] =
    val sorted = if grids.isEmpty then Vector.empty else interiors.sortBy(_.bounds.min.x)
    val boxes = sorted.filter(_.isGrid)
    val boxesBefore = sorted.scanLeft(0)((count, a) => if a.isGrid then count + 1 else count)
    for
      i <- sorted.indices.iterator
      a = sorted(i)
      // Meshes don't look for other meshes
      later = if a.isGrid then sorted.iterator.drop(i + 1) else boxes.iterator.drop(boxesBefore(i))
      b <- later.takeWhile(_.bounds.min.x <= a.bounds.max.x) if a.overlaps(b)
    yield if a.isGrid then (a, b) else (b, a)

  private def withCamera(scene: SceneDescription): SceneDescription =
    val toWorld = scene.worldToCamera.start.inverse
    val startMedia = View.rayStarts(scene).map(p => mediumAt(toWorld.point(p)))
    for camera <- scene.camera if startMedia.distinct.size > 1 do
      val message = "rays of this camera begin in several media; using that of the middle for all"
      session.warn(camera.pos, message)
    scene.copy(cameraMedium = startMedia.headOption.getOrElse(""))

  /** The innermost medium at a point; empty: none. */
  private def mediumAt(p: Vec3): String =
    interiors.filter(_.contains(p)).minByOption(_.bounds.radius).fold("")(_.medium)

/** A mesh that a medium fills.
  *
  * @param isGrid   whether it is the box of a grid
  * @param isShared whether it has instances
  */
private final case class Interior(
    medium: String,
    mesh: FilledMesh,
    toWorld: Transform,
    isGrid: Boolean,
    isShared: Boolean
):
  /** In the world, with what surfaces must be apart to be told apart. */
  val bounds: Bounds3 =
    val tight = mesh.bounds.mapped(toWorld.point)
    val reach = tight.reach
    tight.grown(Interior.Margin * Math.max(reach.x, Math.max(reach.y, reach.z)))

  def overlaps(b: Interior): Boolean =
    val (low, high) = (bounds, b.bounds)
    low.min.x <= high.max.x && low.max.x >= high.min.x &&
    low.min.y <= high.max.y && low.max.y >= high.min.y &&
    low.min.z <= high.max.z && low.max.z >= high.min.z

  def contains(p: Vec3): Boolean =
    bounds.union(p) == bounds && !toWorld.isFlat && mesh.winding(toWorld.inverse.point(p)) > 0.5

  /** Whether all of a mesh that has no instances is within this box. */
  def surrounds(inner: Interior): Boolean =
    val inside = mesh.bounds.grown(-Interior.Margin * mesh.bounds.radius)
    !inner.isGrid && !inner.isShared && !toWorld.isFlat && {
      val toBox = toWorld.inverse * inner.toWorld
      inner.mesh.vertices.forall(p => inside.union(toBox.point(p)) == inside)
    }

private object Interior:
  /** More than the rounding errors of intersections, of the coordinates. */
  private val Margin = 1e-5f

/** Primitives that bound one medium together, in the space of their mesh. */
private final class FilledMesh(parts: Vector[Declaration]):
  private val corners = parts.map(d => (d.param("P").get.floats, d.param("indices").get.ints))

  val at = parts.head.pos

  def vertices: Iterator[Vec3] =
    corners.iterator.flatMap((p, _) => Iterator.range(0, p.length / 3).map(FilledMesh.vertex(p, _)))

  val bounds: Bounds3 = vertices.foldLeft(Bounds3.Empty)(_.union(_))

  private inline def forEachFace(inline f: (Vec3, Vec3, Vec3) => Unit): Unit =
    for (p, indices) <- corners do
      def vertex(i: Int) = FilledMesh.vertex(p, indices(i))
      loop(indices.length / 3)(k => f(vertex(3 * k), vertex(3 * k + 1), vertex(3 * k + 2)))

  /** How often the mesh surrounds a point: once inside, if it is closed.
    *
    * Source: Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", IEEE Transactions on
    * Biomedical Engineering 30(2), 1983.
    */
  def winding(point: Vec3): Double =
    var sum = 0.0
    forEachFace: (v0, v1, v2) =>
      val (a, b, c) = (v0 - point, v1 - point, v2 - point)
      val (x, y, z) = (a.length, b.length, c.length)
      val y0 = a dot (b cross c)
      val x0 = x * y * z + (a dot b) * z + (b dot c) * x + (c dot a) * y
      sum += Math.atan2(y0.toDouble, x0.toDouble)
    sum / (2 * Math.PI)

  /** Whether its faces don't add up to nothing, as those of closed meshes do. */
  def isOpen: Boolean =
    var sum = Vec3.Zero
    var area = 0f
    forEachFace: (a, b, c) =>
      val normal = (b - a) cross (c - a)
      sum = sum + normal
      area += normal.length
    sum.length > FilledMesh.MaxGap * area

private object FilledMesh:
  /** Part of the area of a mesh that may be missing. */
  private val MaxGap = 1e-3f

  private def vertex(p: Array[Float], i: Int) = Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2))
