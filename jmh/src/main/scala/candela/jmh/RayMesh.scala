package candela.jmh

import java.util.SplittableRandom

import candela.accel.Primitives
import candela.math.*
import candela.shapes.{BumpTangents, Mesh, TriangleSoup}

/** A mesh of about a given number of triangles, the same in every run: hills with bumpy balls of
  * many sizes over them, so that rays graze, pass gaps and find several surfaces on their way.
  */
object RayMesh:
  def apply(triangles: Int): TriangleSoup =
    val mesh = new RayMesh()
    // A quarter of them is ground, the rest in balls
    val side = Math.sqrt(triangles / 8.0).toInt
    mesh.add(side, side): (u, v) =>
      val (x, y) = (10f * u - 5f, 10f * v - 5f)
      val hills = 0.4f * sin(1.3f * x) * cos(1.1f * y) + 0.1f * sin(5.1f * x + 3f * y)
      Vec3(x, y, hills + 0.01f * sin(97f * x) * sin(89f * y))
    val random = SplittableRandom(5)
    def draw(low: Float, high: Float) = random.nextDouble(low, high).toFloat
    val rows = Math.sqrt(triangles * 0.75 / Balls / 4.0).toInt
    for _ <- 0 until Balls do
      val centre = Vec3(draw(-4f, 4f), draw(-4f, 4f), draw(0f, 3f))
      val radius = 0.05f + 0.9f * cube(draw(0f, 1f))
      val (waves, depth, phase) = (draw(3f, 25f), draw(0f, 0.2f), draw(0f, 6f))
      mesh.add(2 * rows, rows): (u, v) =>
        val (phi, theta) = (TwoPi * u, Pi * v)
        val out = Vec3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta))
        val bump = sin(waves * out.x + phase) * sin(waves * out.y) * cos(waves * out.z)
        centre + out * (radius * (1f + depth * bump))
    mesh.result

  private inline val Balls = 60
  private def cube(x: Float): Float = x * x * x

  def primitives(soup: TriangleSoup): Primitives = Primitives(soup, Array.empty)

final class RayMesh private ():
  private val positions = Array.newBuilder[Float]
  private val indices = Array.newBuilder[Int]
  private var vertices = 0

  /** A net of columns × rows quads over the unit square. */
  def add(columns: Int, rows: Int)(point: (Float, Float) => Vec3): Unit =
    for j <- 0 to rows; i <- 0 to columns do
      val p = point(i.toFloat / columns, j.toFloat / rows)
      positions ++= Array(p.x, p.y, p.z)
    for j <- 0 until rows; i <- 0 until columns do
      val a = vertices + j * (columns + 1) + i
      val b = a + columns + 1
      indices ++= Array(a, a + 1, b, b, a + 1, b + 1)
    vertices += (columns + 1) * (rows + 1)

  def result: TriangleSoup =
    val all = indices.result()
    val count = all.length / 3
    val mesh =
      Mesh(0, 0, count, Array.empty, Array.empty, false, 0, -1, BumpTangents.Along)
    TriangleSoup(positions.result(), all, Array(mesh), tangents = false)
