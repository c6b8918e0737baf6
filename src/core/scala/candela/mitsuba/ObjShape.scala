package candela.mitsuba

import candela.base.{FloatBuffer, IntBuffer, loop}
import candela.build.shapes.{CornerVertices, ObjFile, ObjMesh}
import candela.diagnostics.{Code, SourcePos}
import candela.io.InputFile

/** Meshes in Wavefront's OBJ format as Mitsuba has them: vertices, normals, coordinates and faces;
  * everything else is ignored. Faces of more than three corners become fans.
  */
object ObjShape:

  /** @param flipped whether v in the file has its origin at the bottom of images
    * @param at      position of the reference in the scene
    */
  def read(file: InputFile, flipped: Boolean, at: SourcePos): Mesh =
    mesh(
      ObjFile.read(file): (line, _, message) =>
        val lineText = if line > 0 then s", line $line" else ""
        Values.fail(Code.DamagedMesh, at, s"mesh `$file`$lineText: $message")
      ,
      flipped
    )

  private def mesh(obj: ObjMesh, flipped: Boolean): Mesh =
    val vertices = CornerVertices()
    val indices = IntBuffer()
    def vertex(c: Int) = vertices(obj.position(c), obj.uv(c), obj.normal(c))
    loop(obj.faces): f =>
      val first = obj.start(f)
      val apex = vertex(first)
      var previous = vertex(first + 1)
      loop(first + 2, obj.ends(f)): c =>
        val current = vertex(c)
        indices += apex
        indices += previous
        indices += current
        previous = current

    /** Numbers of all vertices; empty if a vertex has none. */
    def gathered(values: Array[Float], each: Int)(index: Int => Int): Array[Float] =
      if (0 until vertices.size).exists(index(_) < 0) then Array.emptyFloatArray
      else
        val buffer = FloatBuffer()
        loop(vertices.size)(i => loop(each)(k => buffer += values(each * index(i) + k)))
        buffer.drain()
    val uvs = gathered(obj.uvs, 2)(vertices.second)
    if flipped then loop(uvs.length / 2)(i => uvs(2 * i + 1) = 1 - uvs(2 * i + 1))
    Mesh(
      gathered(obj.positions, 3)(vertices.first),
      gathered(obj.normals, 3)(vertices.third),
      uvs,
      indices.drain(),
      if obj.rests.isEmpty then obj.rests else gathered(obj.rests, 3)(vertices.first)
    )
