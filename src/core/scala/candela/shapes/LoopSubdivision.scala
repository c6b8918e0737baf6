package candela.shapes

import candela.base.loop
import scala.collection.mutable

/** A subdivision surface as triangles: limit positions and normals of the vertices.
  *
  * @param positions x, y, z per vertex
  * @param normals   x, y, z per vertex; their lengths differ, the longest is 1. See
  *   [[LoopSubdivision]].
  * @param indices   three vertices per triangle, in the winding of the input
  * @param crowded   what is said of an edge with more than two faces, if there is one
  */
final class SubdividedMesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val indices: Array[Int],
    val crowded: Option[String]
)

/** Loop subdivision: each level splits every triangle in four and smooths the vertices; after the
  * last level, vertices are moved to the limit surface.
  *
  * Reproduces pbrt's mesh (v2, v3 and v4 agree), including its conventions:
  * - Vertices keep their numbers; edge vertices follow, in the order of faces and their edges.
  * - Normals come from the limit positions of the one-ring. They point to the side from which the
  *   faces wind ''clockwise'', against the right-hand rule, and pbrt makes that the outside of the
  *   surface. Their lengths are weights when a triangle interpolates its corners' normals, so they
  *   are kept up to one common factor.
  * - Boundary limit points use the weights 1/5, 3/5, 1/5, which Hoppe et al. give for other
  *   refinement rules than those used here (these would have 1/6, 2/3, 1/6).
  * - Where several fans of faces touch in one vertex, the fan of the last face determines it.
  * - Of three faces at an edge, the first two are neighbours; the third ends there, but shares the
  *   vertex that the others put on the edge.
  *
  * Sources: Loop, "Smooth subdivision surfaces based on triangles", 1987; Hoppe et al., "Piecewise
  * smooth surface reconstruction", SIGGRAPH 1994; Warren, "Subdivision methods for geometric
  * design", 1995 (weights by valence); PBRT 3rd ed., §3.8.
  */
object LoopSubdivision:
  import CornerTable.{next, previous}

  /** @param levels    number of subdivision levels, from 0
    * @param indices   three vertices per face; neighbours have consistent winding
    * @param positions x, y, z per vertex; unreferenced vertices are removed
    * @throws MeshError if neighbours wind opposite ways
    */
  def subdivide(levels: Int, indices: Array[Int], positions: Array[Float]): SubdividedMesh =
    MeshInput.check(levels, indices, positions)
    val (vertices, oldIndices) = MeshInput.withoutUnused(indices, positions.length / 3)
    var table = CornerTable.of(vertices, oldIndices.length)
    var points =
      Array.tabulate(3 * oldIndices.length)(i => positions(3 * oldIndices(i / 3) + i % 3).toDouble)
    // Refined vertices have their parent's valence, or at most 6: one buffer serves all levels.
    val ring = new Array[Int](Math.max(table.longestRing, 6))
    val crowded = table.crowded.map(CornerTable.described(_, indices))
    loop(levels): _ =>
      val odd = OddVertices.of(table)
      points = refinedPoints(table, points, odd, ring)
      table = refinedTable(table, odd)
    val limit = moved(table, points, 3 * table.vertexCount, 1.0 / 5, limitWeight, ring)
    val normals = LoopNormals.of(table, limit, ring)
    SubdividedMesh(limit.map(_.toFloat), normals, table.vertices, crowded)

  /** Weight of each neighbour in the new position of an interior vertex (Warren). */
  private def evenWeight(valence: Int): Double =
    if valence == 3 then 3.0 / 16 else 3.0 / (8 * valence)

  /** Weight of each neighbour in the limit point of an interior vertex. */
  private def limitWeight(valence: Int): Double =
    1 / (valence + 3 / (8 * evenWeight(valence)))

  private def refinedPoints(
      table: CornerTable,
      points: Array[Double],
      odd: OddVertices,
      ring: Array[Int]
  ): Array[Double] =
    val refined = moved(table, points, 3 * odd.end, 1.0 / 8, evenWeight, ring)
    loop(odd.length): corner =>
      val twin = table.twins(corner)
      if odd.isLast(corner) then // visits each edge once
        val from = 3 * table.vertices(corner)
        val to = 3 * table.vertices(next(corner))
        val offset = 3 * odd(corner)
        if twin < 0 then
          loop(3)(axis => refined(offset + axis) = (points(from + axis) + points(to + axis)) / 2)
        else
          val opposite = 3 * table.vertices(previous(corner))
          val twinOpposite = 3 * table.vertices(previous(twin))
          loop(3): axis =>
            refined(offset + axis) = (points(from + axis) + points(to + axis)) * 3 / 8 +
              (points(opposite + axis) + points(twinOpposite + axis)) / 8
    refined

  /** Smoothed positions of all vertices of `table`, at the start of an array of `size` numbers.
    *
    * @param edgeWeight weight of the two neighbours along the boundary
    * @param weight     weight of each neighbour of an interior vertex, by valence
    */
  private def moved(
      table: CornerTable,
      points: Array[Double],
      size: Int,
      edgeWeight: Double,
      weight: Int => Double,
      ring: Array[Int]
  ): Array[Double] =
    val result = new Array[Double](size)
    loop(table.vertexCount): vertex =>
      val count = table.ring(vertex, ring)
      val inside = count > 0
      val w = if inside then weight(count) else edgeWeight
      loop(3): axis =>
        var sum = 0.0
        if inside then loop(count)(i => sum += points(3 * ring(i) + axis))
        else sum = points(3 * ring(0) + axis) + points(3 * ring(-count - 1) + axis)
        val ownWeight = 1 - w * (if inside then count else 2)
        result(3 * vertex + axis) = ownWeight * points(3 * vertex + axis) + w * sum
    result

  /** Face f becomes the faces 4f + k at its corners k and 4f + 3 in the middle:
    * {{{
    *          2
    *         / \          child k has the old vertex k at its corner k, and the odd vertices of
    *     o2 /___\ o1      the edges k and k − 1 at its corners k + 1 and k − 1;
    *       / \3/ \        child 3 has the odd vertex of edge k at its corner k
    *      0___o0__1
    * }}}
    */
  private def refinedTable(table: CornerTable, odd: OddVertices): CornerTable =
    val vertices = new Array[Int](4 * odd.length)
    val twins = new Array[Int](4 * odd.length)
    val start = new Array[Int](odd.end)
    loop(odd.length): corner =>
      val previousCorner = previous(corner)
      val middle = child(corner, 3)
      val outer = child(corner, corner % 3)
      val outerNext = turned(outer, corner, next(corner))
      val outerPrevious = turned(outer, corner, previousCorner)
      vertices(outer) = table.vertices(corner)
      vertices(outerNext) = odd(corner)
      vertices(outerPrevious) = odd(previousCorner)
      vertices(middle) = odd(corner)
      val twin = table.twins(corner)
      val twinBehind = table.twins(previousCorner)
      twins(outer) = if twin < 0 then -1
      else
        val twinCorner = next(twin) // the same vertex, in the neighbour
        turned(child(twinCorner, twinCorner % 3), twinCorner, twin)
      twins(outerPrevious) = if twinBehind < 0 then -1 else child(twinBehind, twinBehind % 3)
      val inner = turned(middle, corner, previousCorner)
      twins(outerNext) = inner
      twins(inner) = outerNext
      if table.start(table.vertices(corner)) == corner then start(table.vertices(corner)) = outer
      if odd.isLast(corner) then start(odd(corner)) = middle
    CornerTable(vertices, twins, start, table.crowded)

  /** Corner `corner % 3` of child `which` of the face of `corner`. */
  private inline def child(corner: Int, which: Int): Int =
    3 * (4 * (corner / 3) + which) + corner % 3

  /** From the corner `at`, numbered as `from`, to the corner numbered as `to`. */
  private inline def turned(at: Int, from: Int, to: Int): Int = at - from % 3 + to % 3

/** The new vertices on the edges of a mesh, numbered after the existing ones.
  *
  * @param ofCorner the one on each corner's edge
  * @param end      the number after the last one
  * @param extra    corners that found another face's vertex on a crowded edge
  */
private final class OddVertices(
    table: CornerTable,
    ofCorner: Array[Int],
    val end: Int,
    extra: Set[Int]
):
  def length: Int = ofCorner.length
  def apply(corner: Int): Int = ofCorner(corner)

  /** Is it the last of the corners that determine the vertex? True of one corner of each edge. */
  def isLast(corner: Int): Boolean =
    table.twins(corner) < corner && (extra.isEmpty || !extra(corner))

private object OddVertices:
  def of(table: CornerTable): OddVertices =
    val odd = new Array[Int](table.vertices.length)
    val onEdge = mutable.HashMap.empty[(Int, Int), Int]
    val extra = Set.newBuilder[Int]
    var count = table.vertexCount
    loop(odd.length): corner =>
      val twin = table.twins(corner)
      val shared =
        if table.crowded.isEmpty || (twin >= 0 && twin < corner) then -1
        else onEdge.getOrElse(edge(table, corner), -1)
      if twin >= 0 && twin < corner then odd(corner) = odd(twin)
      else if shared >= 0 then odd(corner) = shared
      else
        odd(corner) = count
        if table.crowded.nonEmpty then onEdge(edge(table, corner)) = count
        count += 1
      if shared >= 0 then extra ++= Seq(corner, twin)
    OddVertices(table, odd, count, extra.result())

  private def edge(table: CornerTable, corner: Int): (Int, Int) =
    val from = table.vertices(corner)
    val to = table.vertices(CornerTable.next(corner))
    (Math.min(from, to), Math.max(from, to))

/** Normals of a subdivision surface: cross products of two tangents, which are weighted sums of the
  * one-ring. Conventions: see [[LoopSubdivision]].
  *
  * Source: Hoppe et al., "Piecewise smooth surface reconstruction", SIGGRAPH 1994, §4; PBRT 3rd
  * ed., §3.8.3.
  */
private[shapes] object LoopNormals:

  /** x, y, z per vertex; the longest has length 1, or all are zero.
    *
    * @param ring scratch buffer for the one-ring of a vertex
    */
  def of(table: CornerTable, points: Array[Double], ring: Array[Int]): Array[Float] =
    val normals = new Array[Double](3 * table.vertexCount)
    val s, t = new Array[Double](3)
    var longest = 0.0
    loop(table.vertexCount): vertex =>
      val signedCount = table.ring(vertex, ring)
      val inside = signedCount > 0
      val count = Math.abs(signedCount)
      java.util.Arrays.fill(s, 0)
      java.util.Arrays.fill(t, 0)
      loop(count): i =>
        val angle = 2 * Math.PI * i / count
        val alongS = if inside then Math.cos(angle) else edgeWeight(i, count)
        val alongT = if inside then Math.sin(angle) else inwardWeight(i, count)
        loop(3): axis =>
          val neighbour = points(3 * ring(i) + axis) - points(3 * vertex + axis)
          s(axis) += alongS * neighbour
          t(axis) += alongT * neighbour
      val x = s(1) * t(2) - s(2) * t(1)
      val y = s(2) * t(0) - s(0) * t(2)
      val z = s(0) * t(1) - s(1) * t(0)
      normals(3 * vertex) = x
      normals(3 * vertex + 1) = y
      normals(3 * vertex + 2) = z
      longest = Math.max(longest, Math.sqrt(x * x + y * y + z * z))
    normals.map(x => if longest > 0 then (x / longest).toFloat else 0f)

  /** Weight in the tangent along the boundary: from its first to its last neighbour. */
  private def edgeWeight(i: Int, count: Int): Double =
    if i == 0 then -1 else if i == count - 1 then 1 else 0

  /** Weight of neighbour `i` of `count` in the tangent from the boundary into the surface.
    * Neighbours are relative to the vertex, whose own weight thus is minus their sum. That is
    * pbrt's weight for up to four neighbours; for more, pbrt's is 0, which is what their weights
    * sum to.
    */
  private def inwardWeight(i: Int, count: Int): Double =
    val atEdge = i == 0 || i == count - 1
    count match
      case 2 => 1
      case 3 => if atEdge then 0 else 1
      case 4 => if atEdge then -1 else 2
      case _ =>
        val theta = Math.PI / (count - 1)
        if atEdge then -Math.sin(theta) else (2 - 2 * Math.cos(theta)) * Math.sin(i * theta)

/** Validates an array of faces before it is read as a surface. */
private[shapes] object MeshInput:

  /** @throws MeshError at the first violation */
  def check(levels: Int, indices: Array[Int], positions: Array[Float]): Unit =
    def fail(message: String) = throw MeshError(message)
    val vertexCount = positions.length / 3
    if levels < 0 then fail(s"levels of subdivision must not be negative, found $levels")
    if positions.length % 3 != 0 then
      fail(s"${positions.length} coordinates are not a multiple of 3")
    if indices.isEmpty then fail("the mesh has no faces")
    if indices.length % 3 != 0 then
      fail(s"${indices.length} indices are not a multiple of 3")
    if indices.length.toDouble * Math.pow(4, levels) > Int.MaxValue - 8 then
      fail(s"$levels levels make too many triangles of ${indices.length / 3}")
    indices.indices.find(i => indices(i) < 0 || indices(i) >= vertexCount).foreach: i =>
      fail(s"face ${i / 3} uses vertex ${indices(i)}; there are $vertexCount, counted from 0")
    positions.indices.find(i => !java.lang.Float.isFinite(positions(i))).foreach: i =>
      fail(s"a coordinate of vertex ${i / 3} is ${positions(i)}")
    loop(indices.length / 3): f =>
      val a = indices(3 * f)
      val b = indices(3 * f + 1)
      val c = indices(3 * f + 2)
      if a == b || b == c || c == a then
        fail(s"face $f uses a vertex twice: $a, $b, $c")

  /** The faces, and the old number of each vertex that they use, in the old order. */
  def withoutUnused(indices: Array[Int], vertexCount: Int): (Array[Int], Array[Int]) =
    val uses = new Array[Boolean](vertexCount)
    indices.foreach(i => uses(i) = true)
    val oldIndices = (0 until vertexCount).filter(i => uses(i)).toArray
    val renumbered = new Array[Int](vertexCount)
    loop(oldIndices.length)(i => renumbered(oldIndices(i)) = i)
    (indices.map(i => renumbered(i)), oldIndices)

/** An invalid mesh. The message names faces and vertices, counted from 0 in input order; the scene
  * reader adds the location.
  */
final class MeshError(message: String) extends RuntimeException(message, null, false, false)
