package candela.shapes

import candela.base.{FloatBuffer, IntBuffer, loop}
import candela.math.*

import scala.collection.mutable

/** A triangle mesh, refined and displaced along its normals.
  *
  * @param positions x, y, z per vertex
  * @param normals   unit normals of the displaced surface, likewise
  * @param uvs       u, v per vertex
  * @param indices   three vertices per triangle
  */
final class DisplacedMesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val uvs: Array[Float],
    val indices: Array[Int]
)

/** Displacement: triangles are split at the middle of their longest edge until all edges are short,
  * and each vertex moves along its normal. Triangles that share an edge split it alike, so that
  * closed meshes stay closed. Reproduces pbrt-v4's meshes.
  */
object DisplacedMesh:

  /** @param normals per vertex, or empty: those of the faces around it
    * @param longest     length of edges in world space, above 0: all get shorter
    * @param maxVertices number of vertices
    * @param height      of a vertex by its position and its uv
    * @throws MeshError if there are too many triangles
    */
  def of(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int],
      toWorld: Transform,
      longest: Float,
      maxVertices: Int = MaxVertices
  )(height: (Vec3, Float, Float) => Float): DisplacedMesh =
    if leastVertices(positions, indices, toWorld, longest) > maxVertices then
      throw tooMany(longest, maxVertices)
    val start = if normals.isEmpty then normalsOf(positions, indices) else normals
    val mesh = Refinement(positions, start, uvs, toWorld, longest, maxVertices)
    loop(indices.length / 3)(f => mesh.add(indices(3 * f), indices(3 * f + 1), indices(3 * f + 2)))
    val fine = mesh.result()
    loop(fine.positions.length / 3): i =>
      val p = vector(fine.positions, i)
      val moved = p + vector(fine.normals, i) * height(p, fine.uvs(2 * i), fine.uvs(2 * i + 1))
      store(fine.positions, i, moved)
    DisplacedMesh(
      fine.positions,
      normalsOf(fine.positions, fine.indices),
      fine.uvs,
      fine.indices
    )

  /** Vertices that the largest triangle needs at least: triangles of these edges have at most √3/4
    * of their square as area, and twice as many triangles as vertices fill a plane (Euler). Edges
    * are not split below the spacing of the coordinates.
    */
  private def leastVertices(
      positions: Array[Float],
      indices: Array[Int],
      toWorld: Transform,
      longest: Float
  ): Double =
    var minCount = 0.0
    loop(indices.length / 3): f =>
      val corners = (0 until 3).map(k => toWorld.point(vector(positions, indices(3 * f + k))))
      val Seq(a, b, c) = corners: @unchecked
      val largest =
        corners.map(p => Math.max(Math.abs(p.x), Math.max(Math.abs(p.y), Math.abs(p.z))))
      val edge = Math.max(longest, 4 * Math.ulp(largest.max)).toDouble
      val area = ((b - a) cross (c - a)).length / 2.0
      minCount = Math.max(minCount, area / (Math.sqrt(3) / 4 * edge * edge) / 2)
    minCount

  private def tooMany(longest: Float, maxVertices: Int) =
    MeshError(s"an edge length of $longest makes more than $maxVertices vertices")

  /** Vertices of the finest mesh: some 4 GB. */
  val MaxVertices: Int = 100_000_000

  private def vector(of: Array[Float], i: Int) = Vec3(of(3 * i), of(3 * i + 1), of(3 * i + 2))

  private def store(to: Array[Float], i: Int, v: Vec3): Unit =
    to(3 * i) = v.x
    to(3 * i + 1) = v.y
    to(3 * i + 2) = v.z

  /** Mean of the faces' unit normals at each vertex. */
  private def normalsOf(positions: Array[Float], indices: Array[Int]): Array[Float] =
    val sums = new Array[Float](positions.length)
    loop(indices.length / 3): f =>
      val corners = (0 until 3).map(k => indices(3 * f + k))
      val Seq(a, b, c) = corners.map(vector(positions, _)): @unchecked
      val n = unit((b - a) cross (c - b))
      for i <- corners do store(sums, i, vector(sums, i) + n)
    loop(positions.length / 3)(i => store(sums, i, unit(vector(sums, i))))
    sums

  private def unit(v: Vec3): Vec3 = if v.lengthSquared > 0f then v.normalized else Vec3.Zero

  /** Splits triangles; mutable. */
  private final class Refinement(
      givenPositions: Array[Float],
      givenNormals: Array[Float],
      givenUvs: Array[Float],
      toWorld: Transform,
      longest: Float,
      maxVertices: Int
  ):
    private val positions, normals, uvs = FloatBuffer()
    private val indices = IntBuffer()
    private var count = givenPositions.length / 3
    private val middles = mutable.LongMap.empty[Int]

    givenPositions.foreach(positions += _)
    givenNormals.foreach(normals += _)
    givenUvs.foreach(uvs += _)

    private def p(i: Int) = Vec3(positions(3 * i), positions(3 * i + 1), positions(3 * i + 2))
    private def n(i: Int) = Vec3(normals(3 * i), normals(3 * i + 1), normals(3 * i + 2))

    /** Length of an edge; 0 if it can't be split, as rounding moves the middle to an end. */
    private def length(a: Int, b: Int): Float =
      val middle = (p(a) + p(b)) * 0.5f
      val longer = Math.max((middle - p(a)).length, (middle - p(b)).length)
      if longer > 0.75f * (p(a) - p(b)).length then 0f
      else (toWorld.point(p(a)) - toWorld.point(p(b))).length

    def result(): DisplacedMesh =
      DisplacedMesh(positions.drain(), normals.drain(), uvs.drain(), indices.drain())

    def add(a: Int, b: Int, c: Int): Unit =
      val (ab, bc, ca) = (length(a, b), length(b, c), length(c, a))
      // Lengths that are not numbers can't be split
      if !(ab >= longest || bc >= longest || ca >= longest) then
        indices += a
        indices += b
        indices += c
      else if ab > bc && ab > ca then split(a, b, c)
      else if bc >= ab && bc > ca then split(b, c, a)
      else split(c, a, b)

    /** Splits the edge from `a` to `b`. */
    private def split(a: Int, b: Int, c: Int): Unit =
      val key = Math.min(a, b).toLong << 32 | Math.max(a, b)
      val middle = middles.getOrElseUpdate(key, newMiddle(a, b))
      add(a, middle, c)
      add(middle, b, c)

    private def newMiddle(a: Int, b: Int): Int =
      val index = count
      count += 1
      if index >= maxVertices then throw tooMany(longest, maxVertices)
      append(positions, (p(a) + p(b)) * 0.5f)
      append(normals, unit(n(a) + n(b)))
      uvs += (uvs(2 * a) + uvs(2 * b)) * 0.5f
      uvs += (uvs(2 * a + 1) + uvs(2 * b + 1)) * 0.5f
      index

    private def append(to: FloatBuffer, v: Vec3): Unit =
      to += v.x
      to += v.y
      to += v.z
