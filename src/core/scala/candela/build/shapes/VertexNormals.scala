package candela.build.shapes

import candela.base.loop
import candela.math.Vec3

/** Normals of the vertices of meshes that have none. */
object VertexNormals:

  /** The sums of [[ofCorners]] at each vertex, of any length. */
  def ofVertices(points: Array[Float], indices: Array[Int]): Array[Float] =
    val sums = new Array[Float](points.length)
    val weighted = ofCorners(points, indices)
    loop(indices.length): c =>
      loop(3)(k => sums(3 * indices(c) + k) += weighted(3 * c + k))
    sums

  /** Normals of the triangles times their angles, at each corner: their sums over the corners of a
    * vertex are smooth.
    *
    * Source: Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", Journal of
    * Graphics Tools 3(1), 1998.
    *
    * @param points  x, y, z of each vertex
    * @param indices three vertices per triangle
    */
  def ofCorners(points: Array[Float], indices: Array[Int]): Array[Float] =
    val result = new Array[Float](3 * indices.length)
    def point(i: Int) = Vec3(points(3 * i), points(3 * i + 1), points(3 * i + 2))
    loop(indices.length / 3): t =>
      val p = Array(indices(3 * t), indices(3 * t + 1), indices(3 * t + 2)).map(point)
      val n = ((p(1) - p(0)) cross (p(2) - p(0)))
      if n.lengthSquared > 0f then
        val unit = n.normalized
        loop(3): c =>
          val a = (p((c + 1) % 3) - p(c)).normalized
          val b = (p((c + 2) % 3) - p(c)).normalized
          val angle = Math.acos(Math.max(-1.0, Math.min(1.0, a.dot(b).toDouble))).toFloat
          if angle.isFinite then
            result(9 * t + 3 * c) = unit.x * angle
            result(9 * t + 3 * c + 1) = unit.y * angle
            result(9 * t + 3 * c + 2) = unit.z * angle
    result
