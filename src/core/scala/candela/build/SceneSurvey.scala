package candela.build

import candela.io.SceneFolder
import scala.util.Try

import candela.build.shapes.PlyFile
import candela.math.{Position, Transform}
import candela.scenefile.{Declaration, Param, SceneDescription, ShapeDescription}

/** Roughly where something is, and how large it is. */
private[build] final case class Extent(middle: Position, size: Double)

/** Finds roughly where a scene is before it is built, from a few of its numbers. */
private[build] final class SceneSurvey(d: SceneDescription):
  import SceneSurvey.*

  def extents(): Vector[Extent] =
    val shapes = d.shapes.flatMap(extent(_, looks = true))
    val instances = d.instances.take(MaxInstances).toVector.flatMap: i =>
      d.objects.getOrElse(i.name, Vector.empty).take(MaxShapes)
        .flatMap(extent(_, looks = true, i.instanceToWorld.start))
    val volumes = d.volumes.flatMap(v => box(v.light, v.lightToWorld.start))
    val solid = shapes ++ instances ++ volumes
    // Emitters may be far off, so they tell little
    if solid.nonEmpty then solid
    else
      d.lights.filterNot(_.light.name == "infinite").flatMap: l =>
        val position = l.light.param("from").filter(_.floats.length == 3).map(_.position(0))
        extentOf(Vector(position.getOrElse(Position.Origin)), l.lightToWorld.start)

private[build] object SceneSurvey:
  /** An estimate uses this many vertices of a mesh, shapes of an object, and instances. */
  private val MaxVertices = 64
  private val MaxShapes = 16
  private val MaxInstances = 4096

  /** @param looks whether to look into files */
  def extent(
      s: ShapeDescription,
      looks: Boolean,
      outer: Transform = Transform.Identity
  ): Option[Extent] =
    extentOf(points(s.shape, looks), outer * s.objectToWorld.start)

  private def points(d: Declaration, looks: Boolean): Vector[Position] =
    def number(name: String, default: Double) =
      d.param(name).filter(_.floats.length == 1).fold(default)(_.number(0))
    def file = d.param("filename").flatMap(_.strings.headOption)
    (d.param("P"), d.param("Pw")) match
      case (Some(p), _) => spread(p.floats.length / 3).map(i => p.position(3 * i))
      case (_, Some(p)) => spread(p.floats.length / 4).map(i => weighted(p, 4 * i))
      case _ if d.name == "plymesh" =>
        file.filter(_ => looks).fold(Vector.empty)(f => vertices(d.folder, f))
      case _ =>
        val r = Math.abs(number("radius", 1))
        def bound(name: String, default: Double) = number(name, number("height", default))
        Vector(Position(-r, -r, bound("zmin", -r)), Position(r, r, bound("zmax", r)))

  private def weighted(p: Param, i: Int): Position =
    val w = p.number(i + 3)
    Position(p.number(i) / w, p.number(i + 1) / w, p.number(i + 2) / w)

  private def vertices(folder: SceneFolder, name: String): Vector[Position] =
    folder.glance(name).flatMap(file =>
      Try(PlyFile.firstPositions(file, MaxVertices)).toOption
    ).fold(
      Vector.empty
    )(p => Vector.tabulate(p.length / 3)(i => Position(p(3 * i), p(3 * i + 1), p(3 * i + 2))))

  private def spread(count: Int): Vector[Int] =
    val step = Math.max(1, count / MaxVertices)
    Vector.range(0, count, step)

  /** The box of a volume. */
  private def box(d: Declaration, toWorld: Transform): Option[Extent] =
    def corner(name: String, default: Double) =
      d.param(name).filter(_.floats.length == 3).fold(Position(default, default, default))(
        _.position(0)
      )
    extentOf(Vector(corner("p0", 0), corner("p1", 1)), toWorld)

  /** Of the points, where a map takes them. */
  private def extentOf(points: Vector[Position], toWorld: Transform): Option[Extent] =
    val mapped =
      points.map(toWorld.position).filter(p => java.lang.Double.isFinite(p.x + p.y + p.z))
    Option.when(mapped.nonEmpty):
      def range(of: Position => Double) = (mapped.map(of).min, mapped.map(of).max)
      val (xs, ys, zs) = (range(_.x), range(_.y), range(_.z))
      val (low, high) = (Position(xs._1, ys._1, zs._1), Position(xs._2, ys._2, zs._2))
      val middle =
        Position((low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2)
      Extent(middle, low.distance(high))
