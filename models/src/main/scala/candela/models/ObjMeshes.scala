package candela.models

import candela.base.{FloatBuffer, IntBuffer, loop}
import candela.build.shapes.{CornerVertices, ObjMesh, VertexNormals}
import candela.geometry.Polygons
import candela.math.Vec3

/** Triangles of the faces of an OBJ file. */
private[models] final class ObjMeshes(obj: ObjMesh):
  private val polygons = Polygons()

  /** Corners of the triangles of each face, and where those of a face end. */
  private val (triangles, ends) =
    val corners, ends = IntBuffer()
    loop(obj.faces): f =>
      val first = obj.start(f)
      polygons.triangulate(obj.positions, obj.ends(f) - first)(i => obj.position(first + i)):
        (a, b, c) =>
          corners += first + a
          corners += first + b
          corners += first + c
      ends += corners.length
    (corners.drain(), ends.drain())

  private def firstCorner(face: Int): Int = if face == 0 then 0 else ends(face - 1)

  /** Number of the smoothing group of each face without normals; 0: it is flat; −1: it has normals.
    */
  private val groups: Array[Int] =
    val result = new Array[Int](obj.faces)
    for (run, i) <- obj.runs.zipWithIndex do
      for f <- obj.facesOf(i) do
        val hasNormals = (obj.start(f) until obj.ends(f)).forall(obj.normal(_) >= 0)
        result(f) = if hasNormals then -1 else run.smoothing & Int.MaxValue
    result

  /** Vertices of smoothing groups: position and group; and the sums of their normals. */
  private val smoothVertices = CornerVertices()
  private val smoothNormals: Array[Float] =
    if !groups.exists(_ > 0) then Array.emptyFloatArray
    else
      val positions = triangles.map(obj.position)
      val weighted = VertexNormals.ofCorners(obj.positions, positions)
      val sums = FloatBuffer()
      loop(obj.faces): f =>
        if groups(f) > 0 then
          loop(firstCorner(f), ends(f)): c =>
            val vertex = smoothVertices(positions(c), groups(f), 0)
            if 3 * vertex == sums.length then loop(3)(_ => sums += 0f)
            loop(3)(k => sums(3 * vertex + k) = sums(3 * vertex + k) + weighted(3 * c + k))
      sums.drain()

  /** The triangles of ranges of faces. */
  def of(ranges: Vector[Range]): Mesh =
    val isFlat = ranges.forall(_.forall(groups(_) == 0))
    val vertices = CornerVertices()
    val indices = IntBuffer()
    // A normal of the file, of a smoothing group, or of a face, as one number each
    val (smooth, flat) = (obj.normals.length / 3, obj.normals.length / 3 + smoothVertices.size)
    for range <- ranges do
      loop(range.start, range.end): f =>
        loop(firstCorner(f), ends(f)): t =>
          val corner = triangles(t)
          val normal =
            if isFlat then -1
            else if groups(f) < 0 then obj.normal(corner)
            else if groups(f) == 0 then flat + f
            else smooth + smoothVertices(obj.position(corner), groups(f), 0)
          indices += vertices(obj.position(corner), obj.uv(corner), normal)
    val hasUvs = (0 until vertices.size).exists(vertices.second(_) >= 0)
    def gathered(values: Array[Float], each: Int)(index: Int => Int) =
      val result = new Array[Float](each * vertices.size)
      loop(vertices.size): i =>
        if index(i) >= 0 then loop(each)(k => result(each * i + k) = values(each * index(i) + k))
      result
    val rests = if obj.rests.isEmpty then obj.rests else gathered(obj.rests, 3)(vertices.first)
    Mesh(
      gathered(obj.positions, 3)(vertices.first),
      indices.drain(),
      if isFlat then Array.emptyFloatArray else normals(vertices, smooth, flat),
      if hasUvs then gathered(obj.uvs, 2)(vertices.second) else Array.emptyFloatArray,
      if obj.colors.isEmpty then obj.colors else colors(vertices),
      rests
    )

  private def normals(vertices: CornerVertices, smooth: Int, flat: Int): Array[Float] =
    val result = new Array[Float](3 * vertices.size)
    loop(vertices.size): i =>
      val n = vertices.third(i)
      if n >= flat then
        val normal = faceNormal(n - flat)
        result(3 * i) = normal.x
        result(3 * i + 1) = normal.y
        result(3 * i + 2) = normal.z
      else
        val (source, start) =
          if n < smooth then (obj.normals, 3 * n) else (smoothNormals, 3 * (n - smooth))
        loop(3)(k => result(3 * i + k) = source(start + k))
    result

  private def faceNormal(face: Int): Vec3 =
    def point(t: Int) =
      val p = 3 * obj.position(triangles(t))
      Vec3(obj.positions(p), obj.positions(p + 1), obj.positions(p + 2))
    (firstCorner(face) until ends(face) by 3).foldLeft(Vec3.Zero): (sum, t) =>
      sum + ((point(t + 1) - point(t)) cross (point(t + 2) - point(t)))

  /** In sRGB, as Blender and MeshLab take them. */
  private def colors(vertices: CornerVertices): Array[Float] =
    Array.tabulate(4 * vertices.size): i =>
      if i % 4 == 3 then 1f
      else MeshFormat.linear(obj.colors(3 * vertices.first(i / 4) + i % 4))
