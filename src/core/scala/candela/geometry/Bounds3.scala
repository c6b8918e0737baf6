package candela.geometry

import candela.base.loop
import candela.math.*

/** An axis-aligned bounding box; `Bounds3.Empty` contains no point. */
final case class Bounds3(min: Vec3, max: Vec3):
  def union(b: Bounds3): Bounds3 = Bounds3(
    Vec3(Math.min(min.x, b.min.x), Math.min(min.y, b.min.y), Math.min(min.z, b.min.z)),
    Vec3(Math.max(max.x, b.max.x), Math.max(max.y, b.max.y), Math.max(max.z, b.max.z))
  )
  def union(p: Vec3): Bounds3 = union(Bounds3(p, p))
  def isEmpty: Boolean = !(min.x <= max.x && min.y <= max.y && min.z <= max.z)
  def extent: Vec3 = max - min
  def center: Vec3 = (min + max) * 0.5f

  def overlaps(b: Bounds3): Boolean =
    min.x <= b.max.x && max.x >= b.min.x &&
      min.y <= b.max.y && max.y >= b.min.y &&
      min.z <= b.max.z && max.z >= b.min.z

  /** With its faces moved outwards. */
  def grown(by: Float): Bounds3 =
    val d = Vec3(by, by, by)
    Bounds3(min - d, max + d)

  /** Radius of the sphere around `center` through the corners. */
  def radius: Float = if isEmpty then 0f else (max - center).length

  /** Writes six Floats: the lower corner, then the upper one. */
  def write(to: Array[Float], at: Int): Unit =
    to(at) = min.x
    to(at + 1) = min.y
    to(at + 2) = min.z
    to(at + 3) = max.x
    to(at + 4) = max.y
    to(at + 5) = max.z

  def corner(i: Int): Vec3 = Vec3(
    if (i & 1) == 0 then min.x else max.x,
    if (i & 2) == 0 then min.y else max.y,
    if (i & 4) == 0 then min.z else max.z
  )

  /** Bounds of what a map makes of the corners. Without collections: there may be millions. */
  inline def mapped(inline map: Vec3 => Vec3): Bounds3 =
    var bounds = Bounds3.Empty
    loop(8)(i => bounds = bounds.union(map(corner(i))))
    bounds

  /** Largest absolute coordinates. */
  def reach: Vec3 = Vec3(
    Math.max(Math.abs(min.x), Math.abs(max.x)),
    Math.max(Math.abs(min.y), Math.abs(max.y)),
    Math.max(Math.abs(min.z), Math.abs(max.z))
  )

object Bounds3:
  val Empty: Bounds3 =
    val inf = Float.PositiveInfinity
    Bounds3(Vec3(inf, inf, inf), Vec3(-inf, -inf, -inf))

  /** What was written there. */
  def read(from: Array[Float], at: Int): Bounds3 = Bounds3(
    Vec3(from(at), from(at + 1), from(at + 2)),
    Vec3(from(at + 3), from(at + 4), from(at + 5))
  )
  def of(points: Iterable[Vec3]): Bounds3 = points.foldLeft(Empty)((b, p) => b.union(p))

/** A bounding sphere: the target of light from infinity. */
final case class Ball(center: Vec3, radius: Float):
  /** Area of its projection, a disk. */
  val area: Float = Pi * radius * radius

object Ball:
  def enclosing(box: Bounds3): Ball =
    Ball(if box.isEmpty then Vec3.Zero else box.center, box.radius)
