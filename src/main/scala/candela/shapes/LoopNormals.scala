package candela.shapes

import candela.base.loop

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
