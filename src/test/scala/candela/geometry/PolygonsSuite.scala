package candela.geometry

import scala.util.Random

import org.scalatest.funsuite.AnyFunSuite

class PolygonsSuite extends AnyFunSuite:
  private type Triangle = (Int, Int, Int)

  private def triangles(points: Vector[(Double, Double)]): Vector[Triangle] =
    // On a slanted plane, so that all three axes matter
    val all = points.flatMap((x, y) => Vector(x, y, 2 * x - 3 * y)).map(_.toFloat).toArray
    val result = Vector.newBuilder[Triangle]
    Polygons().triangulate(all, points.size)(identity)((a, b, c) => result += ((a, b, c)))
    result.result()

  private def area(points: Vector[(Double, Double)])(corners: Seq[Int]): Double =
    val p = corners.map(points)
    p.indices.map { i =>
      val ((x0, y0), (x1, y1)) = (p(i), p((i + 1) % p.size))
      (x0 * y1 - x1 * y0) / 2
    }.sum

  /** All turn as the polygon does, and together have its area: none lies outside. */
  private def isDivided(points: Vector[(Double, Double)]): Boolean =
    val all = triangles(points)
    val whole = area(points)(points.indices)
    val areas = all.map(t => area(points)(Seq(t._1, t._2, t._3)))
    all.size == points.size - 2 && areas.forall(a => a * whole >= -1e-4 * whole * whole) &&
    Math.abs(areas.sum - whole) < 1e-5 * Math.abs(whole)

  test("a convex polygon is a fan"):
    assert(triangles(Vector((0, 0), (1, 0), (1, 1), (0, 1))) == Vector((0, 1, 2), (0, 2, 3)))

  test("the triangles of a concave polygon lie within it, in either direction"):
    val arrow = Vector((0.0, 0.0), (4.0, 4.0), (0.0, 1.0), (-4.0, 4.0))
    assert(isDivided(arrow) && isDivided(arrow.reverse))
    assert(isDivided(arrow.drop(1) ++ arrow.take(1)))

  test("a hole that a bridge joins to the border stays open"):
    val outer = Vector((0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0))
    val hole = Vector((2.0, 2.0), (2.0, 4.0), (4.0, 4.0), (4.0, 2.0))
    assert(isDivided((outer :+ outer.head) ++ (hole :+ hole.head)))

  test("random stars are divided"):
    val random = Random(7)
    for trial <- 0 until 200 do
      val count = 4 + random.nextInt(60)
      val star = Vector.tabulate(count): i =>
        val (angle, radius) = (2 * Math.PI * i / count, 0.2 + random.nextDouble())
        (radius * Math.cos(angle), radius * Math.sin(angle))
      assert(isDivided(star), s"trial $trial: $star")

  test("a polygon that meets itself, and one without area, have as many triangles"):
    for points <- Vector(
        Vector((0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (0.5, 3.0)),
        Vector.fill(6)((1.0, 1.0))
      )
    do assert(triangles(points).size == points.size - 2)
