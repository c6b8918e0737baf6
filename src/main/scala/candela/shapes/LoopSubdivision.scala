package candela.shapes

import candela.base.loop

/** A smooth surface as triangles: points of the limit surface and its normals, vertex by vertex.
  *
  * @param positions x, y, z for each vertex
  * @param normals   x, y, z for each vertex; their lengths differ, the longest is 1. See
  *                  [[LoopSubdivision]].
  * @param indices   three vertices for each triangle, in the winding of the input
  */
final class SubdividedMesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val indices: Array[Int]
)

/** Loop subdivision: each level splits every triangle in four and moves the vertices towards a
  * smooth limit, onto which the last level's vertices are then pushed.
  *
  * It makes pbrt's mesh (v2, v3 and v4 agree), with pbrt's habits:
  *  - Vertices keep their numbers; those on edges follow, in the order of faces and their edges.
  *  - Normals come from the limit positions of a vertex's neighbours. They point to the side from
  *    which the faces wind ''clockwise'', against the right-hand rule, and pbrt makes that the
  *    outside of the surface. Their lengths weigh them where a triangle interpolates its corners'
  *    normals, so they are left as they are but for one common factor.
  *  - On the boundary the limit point has the weights 1/5, 3/5, 1/5, which Hoppe et al. give for
  *    other refinement rules than those used here (these would have 1/6, 2/3, 1/6).
  *  - Where several fans of faces touch in one vertex, the fan of the last face shapes it.
  *
  * Sources: Loop, "Smooth subdivision surfaces based on triangles", 1987; Hoppe et al., "Piecewise
  * smooth surface reconstruction", SIGGRAPH 1994; Warren, "Subdivision methods for geometric
  * design", 1995 (weights by valence); PBRT 3rd ed., §3.8.
  */
object LoopSubdivision:
  import CornerTable.{next, previous}

  /** @param levels    how often to split, from 0
    * @param indices   three vertices for each face; neighbours wind the same way
    * @param positions x, y, z for each vertex; vertices that no face uses are left out
    * @throws MeshError if the faces form no surface, with or without boundary
    */
  def subdivide(levels: Int, indices: Array[Int], positions: Array[Float]): SubdividedMesh =
    MeshInput.check(levels, indices, positions)
    val (vertices, used) = MeshInput.withoutUnused(indices, positions.length / 3)
    var table = CornerTable.of(vertices, used.length)
    var points = Array.tabulate(3 * used.length)(i => positions(3 * used(i / 3) + i % 3).toDouble)
    // Refined vertices have their parent's valence or 6 at most: one buffer serves all levels.
    val ring = new Array[Int](Math.max(table.longestRing, 6))
    loop(levels): _ =>
      val odd = oddVertices(table)
      points = refinedPoints(table, points, odd, ring)
      table = refinedTable(table, odd)
    val limit = moved(table, points, 3 * table.vertexCount, 1.0 / 5, limitWeight, ring)
    SubdividedMesh(limit.map(_.toFloat), LoopNormals.of(table, limit, ring), table.vertices)

  /** The weight of each neighbour when an inner vertex moves (Warren). */
  private def evenWeight(valence: Int): Double =
    if valence == 3 then 3.0 / 16 else 3.0 / (8 * valence)

  /** The weight of each neighbour in the limit point of an inner vertex. */
  private def limitWeight(valence: Int): Double =
    1 / (valence + 3 / (8 * evenWeight(valence)))

  /** For each corner the new vertex on its edge, numbered on from the old ones. */
  private def oddVertices(table: CornerTable): Array[Int] =
    val odd = new Array[Int](table.vertices.length)
    var count = table.vertexCount
    loop(odd.length): corner =>
      val twin = table.twins(corner)
      if twin >= 0 && twin < corner then odd(corner) = odd(twin)
      else
        odd(corner) = count
        count += 1
    odd

  private def refinedPoints(
      table: CornerTable,
      points: Array[Double],
      odd: Array[Int],
      ring: Array[Int]
  ): Array[Double] =
    val refined = moved(table, points, 3 * (odd.max + 1), 1.0 / 8, evenWeight, ring)
    loop(odd.length): corner =>
      val twin = table.twins(corner)
      if twin < corner then // so each edge has one turn
        val from = 3 * table.vertices(corner)
        val to = 3 * table.vertices(next(corner))
        val at = 3 * odd(corner)
        if twin < 0 then
          loop(3)(axis => refined(at + axis) = (points(from + axis) + points(to + axis)) / 2)
        else
          val here = 3 * table.vertices(previous(corner))
          val there = 3 * table.vertices(previous(twin))
          loop(3): axis =>
            refined(at + axis) = (points(from + axis) + points(to + axis)) * 3 / 8 +
              (points(here + axis) + points(there + axis)) / 8
    refined

  /** All vertices of `table`, moved towards their neighbours, at the head of `size` numbers.
    *
    * @param edgeWeight of the two neighbours along the boundary
    * @param weight     of each neighbour of an inner vertex, by their number
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
        val own = 1 - w * (if inside then count else 2)
        result(3 * vertex + axis) = own * points(3 * vertex + axis) + w * sum
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
  private def refinedTable(table: CornerTable, odd: Array[Int]): CornerTable =
    val vertices = new Array[Int](4 * odd.length)
    val twins = new Array[Int](4 * odd.length)
    val start = new Array[Int](odd.max + 1)
    loop(odd.length): corner =>
      val behind = previous(corner)
      val middle = child(corner, 3)
      val own = child(corner, corner % 3)
      val ahead = turned(own, corner, next(corner))
      val back = turned(own, corner, behind)
      vertices(own) = table.vertices(corner)
      vertices(ahead) = odd(corner)
      vertices(back) = odd(behind)
      vertices(middle) = odd(corner)
      val twin = table.twins(corner)
      val twinBehind = table.twins(behind)
      twins(own) = if twin < 0 then -1
      else
        val there = next(twin) // the same vertex, in the neighbour
        turned(child(there, there % 3), there, twin)
      twins(back) = if twinBehind < 0 then -1 else child(twinBehind, twinBehind % 3)
      val inner = turned(middle, corner, behind)
      twins(ahead) = inner
      twins(inner) = ahead
      if table.start(table.vertices(corner)) == corner then start(table.vertices(corner)) = own
      if table.twins(corner) < corner then start(odd(corner)) = middle
    CornerTable(vertices, twins, start)

  /** Corner `corner % 3` of child `which` of the face of `corner`. */
  private inline def child(corner: Int, which: Int): Int =
    3 * (4 * (corner / 3) + which) + corner % 3

  /** From the corner `at` with the number of `from` to the one with the number of `to`. */
  private inline def turned(at: Int, from: Int, to: Int): Int = at - from % 3 + to % 3

/** Normals of a subdivision surface: products of two tangents, which are weighted sums of a
  * vertex's neighbours. Conventions: see [[LoopSubdivision]].
  *
  * Source: Hoppe et al., "Piecewise smooth surface reconstruction", SIGGRAPH 1994, §4; PBRT 3rd
  * ed., §3.8.3.
  */
private[shapes] object LoopNormals:

  /** x, y, z for each vertex; the longest has length 1, all are zero if none has a length.
    *
    * @param ring work space for the neighbours of one vertex
    */
  def of(table: CornerTable, points: Array[Double], ring: Array[Int]): Array[Float] =
    val normals = new Array[Double](3 * table.vertexCount)
    val s, t = new Array[Double](3)
    var longest = 0.0
    loop(table.vertexCount): vertex =>
      val found = table.ring(vertex, ring)
      val inside = found > 0
      val count = Math.abs(found)
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

  /** In the tangent along the boundary: from its first to its last neighbour. */
  private def edgeWeight(i: Int, count: Int): Double =
    if i == 0 then -1 else if i == count - 1 then 1 else 0

  /** The weight of neighbour `i` of `count` in the tangent that leads from the boundary into the
    * surface. Neighbours count relative to the vertex, whose own weight so is minus the sum of
    * theirs. That is pbrt's for up to four; for more it is 0, which is what their weights sum to.
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

/** What must hold before an array of faces is looked at as a surface. */
private[shapes] object MeshInput:

  /** @throws MeshError at the first thing that is wrong */
  def check(levels: Int, indices: Array[Int], positions: Array[Float]): Unit =
    def fail(message: String) = throw MeshError(message)
    val vertexCount = positions.length / 3
    if levels < 0 then fail(s"a mesh can't be subdivided $levels times")
    if positions.length % 3 != 0 then
      fail(s"${positions.length} coordinates are no whole number of points")
    if indices.isEmpty then fail("a mesh without faces")
    if indices.length % 3 != 0 then
      fail(s"${indices.length} indices are no whole number of triangles")
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

  /** The faces, and for each vertex that they use its old number, in the old order. */
  def withoutUnused(indices: Array[Int], vertexCount: Int): (Array[Int], Array[Int]) =
    val uses = new Array[Boolean](vertexCount)
    indices.foreach(i => uses(i) = true)
    val used = (0 until vertexCount).filter(i => uses(i)).toArray
    val renumbered = new Array[Int](vertexCount)
    loop(used.length)(i => renumbered(used(i)) = i)
    (indices.map(i => renumbered(i)), used)

/** A mesh that can't be what its author meant. The message names the faces and vertices, counted
  * from 0 in the order of the input; who reads scene files adds the place.
  */
final class MeshError(message: String) extends RuntimeException(message, null, false, false)
