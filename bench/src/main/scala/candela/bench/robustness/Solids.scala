package candela.bench.robustness

import candela.math.*
import candela.shapes.{LoopSubdivision, Mesh, Sphere, TriangleSoup}

/** Meshes and shapes to measure with, made from a few words. */
object Solids:
  type Triangle = (Vec3, Vec3, Vec3)

  val Empty: TriangleSoup =
    TriangleSoup(Array.empty, Array.empty, Array.empty, tangents = false)

  def flat(points: Iterable[Vec3]): Array[Float] =
    points.flatMap(p => Seq(p.x, p.y, p.z)).toArray

  /** One mesh of facets, three vertices each. */
  def of(triangles: Seq[Triangle], flipped: Boolean = false): TriangleSoup =
    indexed(
      flat(triangles.flatMap((a, b, c) => Seq(a, b, c))),
      Array.range(0, 3 * triangles.size),
      flipped
    )

  def indexed(
      positions: Array[Float],
      indices: Array[Int],
      flipped: Boolean = false
  ): TriangleSoup =
    val count = indices.length / 3
    val mesh = Mesh(0, 0, count, Array.empty, Array.empty, flipped, material = 0, firstLight = -1)
    TriangleSoup(positions, indices, Array(mesh), tangents = true)

  /** A sphere of 8·4ˡᵉᵛᵉˡˢ facets with its corners on it; seen from outside it winds clockwise or
    * not as `toWorld` mirrors or not.
    */
  def icosphere(levels: Int, toWorld: Transform): TriangleSoup =
    val corners = Array[Float](1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1)
    val faces =
      Array(0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5)
    val mesh = LoopSubdivision.subdivide(levels, faces, corners)
    val points = mesh.positions.grouped(3).map(p => Vec3(p(0), p(1), p(2)).normalized)
    indexed(flat(points.map(toWorld.point).toSeq), mesh.indices)

  /** Triangles of about `size` around the points that `centre` gives. */
  def randomTriangles(draws: Draws, count: Int, size: Float)(centre: => Vec3): Seq[Triangle] =
    Seq.fill(count):
      val c = centre
      (c + draws.vec(-size, size), c + draws.vec(-size, size), c + draws.vec(-size, size))

  def sphere(toWorld: Transform, radius: Float, reversed: Boolean = false): Sphere =
    Sphere(toWorld, radius, -radius, radius, TwoPi, reversed)
