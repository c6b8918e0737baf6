package candela.build.shapes

/** The sides of the triangles of a mesh in pbrt-v2, where rays see the normal ∂p/∂u × ∂p/∂v.
  * Samples of area lights have the normal of the winding.
  */
private[build] object UvSides:

  /** The triangles whose u and v wind as their corners do, and those whose normal is turned over:
    * with mirrored or degenerate uv. The second is true for these.
    */
  def of(mesh: ShapeGeometry.Triangles): Vector[(ShapeGeometry.Triangles, Boolean)] =
    val (turned, plain) =
      if mesh.uvs.isEmpty then (Array.empty[Array[Int]], Array(mesh.indices))
      else mesh.indices.grouped(3).toArray.partition(t => !(area(mesh.uvs, t) > 0f))
    Vector((plain, false), (turned, true)).collect:
      case (triangles, isTurned) if triangles.nonEmpty =>
        val indices = triangles.flatten
        val isWhole = indices.length == mesh.indices.length
        (if isWhole then mesh else mesh.copy(indices = indices, content = None), isTurned)

  private def area(uvs: Array[Float], triangle: Array[Int]): Float =
    def along(corner: Int, axis: Int) =
      uvs(2 * triangle(corner) + axis) - uvs(2 * triangle(2) + axis)
    along(0, 0) * along(1, 1) - along(0, 1) * along(1, 0)
