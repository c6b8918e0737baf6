package candela.bench.robustness

import candela.accel.{Accelerator, Primitives}
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.shapes.TriangleSoup

/** Distances of hits on triangles across an axis, in a plane close to zero or in it: there the
  * distance is one difference and one quotient, so that Doubles know it to 16 digits.
  */
object HitDistances:
  /** Relative error from which a distance counts as wrong: a few roundings of Floats. */
  final val Allowed = 1e-6

  private val planes =
    Array(0f, -0f, 1e-45f, -1e-38f, 1e-30f, 1e-20f, -1e-12f, 1e-7f, 1e-5f, -1e-3f, 1f, 0.1f)
  private final val Count = 48
  private final val HalfSide = 2f
  private final val Spacing = 20f

  /** A point of plane `k`, at (a, b) from its centre and `height` above it. */
  private def point(k: Int, a: Float, b: Float, height: Float): Vec3 =
    val p = new Array[Float](3)
    p(k % 3) = planes(k % planes.length) + height
    p((k + 1) % 3) = Spacing * (k / 3 + 1) + a
    p((k + 2) % 3) = b
    Vec3(p(0), p(1), p(2))

  /** Squares of two triangles, none of which is near another one. */
  val soup: TriangleSoup = Solids.of((0 until Count).flatMap: k =>
    def corner(a: Float, b: Float) = point(k, a * HalfSide, b * HalfSide, 0f)
    Seq(
      (corner(-1, -1), corner(1, -1), corner(1, 1)),
      (corner(-1, -1), corner(1, 1), corner(-1, 1))
    ))

  /** Rays from 1e-6 to 4 before a square to a point of it. */
  final class Aim(trials: Trials):
    private val draws = trials.draws(3)

    /** @return the distance to the square, in lengths of the ray's direction */
    def next(ray: Ray): Double =
      val k = draws.below(Count)
      val axis = k % 3
      def inside() = draws.between(-0.9f, 0.9f) * HalfSide
      val height = draws.magnitude(1e-6, 4) * (if draws.coin() then 1f else -1f)
      val o = point(k, inside(), inside(), height)
      // Across the plane by a thousandth of its length at least, so that it hits the square
      val to = point(k, inside(), inside(), 0f) - o
      ray.set(o, if draws.coin() then to else to.normalized, Float.PositiveInfinity)
      val d = if axis == 0 then ray.dx else if axis == 1 then ray.dy else ray.dz
      (planes(k % planes.length).toDouble - ray.along(axis)) / d

  def tally(create: Primitives => Accelerator, trials: Trials): Tally =
    val accelerator = create(Primitives(soup, Array.empty))
    val (ray, hit, aim) = (Ray(), Hit(), Aim(trials))
    Tally.of(trials.count): _ =>
      val expected = aim.next(ray)
      val isMet = accelerator.closest(ray, hit)
      if isMet && isRight(ray.tMax, expected) then Tally.Sound
      else
        val actual = if isMet then s"at ${ray.tMax}" else "nothing"
        s"$actual instead of $expected from ${ray.ox} ${ray.oy} ${ray.oz} along " +
          s"${ray.dx} ${ray.dy} ${ray.dz}"

  def isRight(actual: Double, expected: Double): Boolean =
    Math.abs(actual - expected) <= Allowed * Math.abs(expected)
