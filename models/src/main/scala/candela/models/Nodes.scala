package candela.models

import candela.diagnostics.Code
import candela.math.Transform

import scala.collection.mutable

/** A node in the world. */
private[models] final case class PlacedNode(node: Json, toWorld: Transform)

/** The tree of nodes, in a pose. */
private[models] final class Nodes(file: GltfFile, session: Session, pose: Pose):
  val entries: Vector[Json] = file.root.list("nodes")

  private val scenes = file.root.list("scenes")

  /** The scene that is to be shown. */
  val scene: Option[Json] =
    file.root.element("scene", scenes, "scenes").orElse(scenes.headOption)

  /** Its nodes, parents before children. */
  val placed: Vector[PlacedNode] =
    val roots = scene.fold(topmost)(_.list("nodes"))
    if scenes.size > 1 then
      session.warn(
        session.at("/scenes"),
        s"one of ${scenes.size} scenes is shown",
        Code.SeveralWorlds
      )
    walk(roots)

  private def topmost: Vector[Json] =
    val children = entries.flatMap(_.list("children")).map(_.size).toSet
    entries.indices.filterNot(children).toVector
      .map(i => Json(ujson.Num(i), s"/nodes/$i", session))

  private def walk(roots: Vector[Json]): Vector[PlacedNode] =
    val visited = mutable.HashSet.empty[Int]
    val all = Vector.newBuilder[PlacedNode]
    val waiting = mutable.Stack.empty[(Json, Transform)]
    waiting.pushAll(roots.reverse.map((_, Transform.Identity)))
    while waiting.nonEmpty do
      val (index, parent) = waiting.pop()
      val node = index.element(entries, "nodes")
      if !visited.add(index.size) then
        Session.fail(
          index.at,
          s"node ${index.size} is reached twice: nodes must form a tree",
          Code.Circle
        )
      val toWorld = parent * Nodes.local(node, pose)
      all += PlacedNode(node, toWorld)
      waiting.pushAll(node.list("children").reverse.map((_, toWorld)))
    all.result()

  /** The transforms of nodes of the scene, by their index. */
  lazy val byIndex: Map[Int, Transform] =
    placed.map(p => Nodes.index(p.node) -> p.toWorld).toMap

private[models] object Nodes:

  /** The index of a node. */
  def index(node: Json): Int = node.pointer.drop("/nodes/".length).toInt

  /** The transform of a node within its parent. */
  private def local(node: Json, pose: Pose): Transform = node("matrix") match
    case Some(m) =>
      val columns = m.numbers(16)
      Transform.fromColumns(columns).getOrElse(flat(columns))
    case None =>
      def numbers(name: String, default: Vector[Double]) =
        pose(node, name).getOrElse(node(name).fold(default)(_.numbers(default.size)))
      of(
        numbers("translation", Vector(0, 0, 0)),
        numbers("rotation", Vector(0, 0, 0, 1)),
        numbers("scale", Vector(1, 1, 1))
      )

  private def flat(columns: Vector[Double]): Transform =
    Transform.flat(Vector.tabulate(16)(i => columns(i % 4 * 4 + i / 4)))

  /** A scale, then a rotation by a quaternion, then a translation. */
  def of(t: Seq[Double], r: Seq[Double], s: Seq[Double]): Transform =
    val length = Math.sqrt(r.map(x => x * x).sum)
    val Seq(x, y, z, w) =
      (if length > 0 then r.map(_ / length) else Seq(0.0, 0.0, 0.0, 1.0)): @unchecked
    val rows = Vector(
      (1 - 2 * (y * y + z * z)) * s(0),
      2 * (x * y - z * w) * s(1),
      2 * (x * z + y * w) * s(2),
      t(0),
      2 * (x * y + z * w) * s(0),
      (1 - 2 * (x * x + z * z)) * s(1),
      2 * (y * z - x * w) * s(2),
      t(1),
      2 * (x * z - y * w) * s(0),
      2 * (y * z + x * w) * s(1),
      (1 - 2 * (x * x + y * y)) * s(2),
      t(2),
      0.0,
      0.0,
      0.0,
      1.0
    )
    Transform.fromRows(rows).getOrElse(Transform.flat(rows))

  /** Without scale, but sheared and mirrored as before: how cameras are placed. */
  def unscaled(t: Transform): Transform =
    withAxes(t, Vector(0, 1, 2).map(c => unit(column(t, c))))

  /** Without scale and shear: how lights are placed. */
  def rigid(t: Transform): Transform =
    def cross(a: Vector[Double], b: Vector[Double]) = Vector(
      a(1) * b(2) - a(2) * b(1),
      a(2) * b(0) - a(0) * b(2),
      a(0) * b(1) - a(1) * b(0)
    )
    val z = unit(column(t, 2))
    val x = unit(cross(column(t, 1), z))
    withAxes(t, Vector(x, cross(z, x), z))

  private def column(t: Transform, c: Int) = Vector(t.m(c), t.m(4 + c), t.m(8 + c))

  private def unit(v: Vector[Double]) =
    val length = Math.sqrt(v.map(x => x * x).sum)
    if length > 0 then v.map(_ / length) else v

  private def withAxes(t: Transform, axes: Vector[Vector[Double]]): Transform =
    val rows = Vector.tabulate(16): i =>
      val (r, c) = (i / 4, i % 4)
      if r == 3 then (if c == 3 then 1.0 else 0.0)
      else axes.map(_(r)).appended(t.m(4 * r + 3))(c)
    Transform.fromRows(rows).getOrElse(Transform.translate(t.m(3), t.m(7), t.m(11)))
