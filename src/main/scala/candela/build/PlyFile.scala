package candela.build

import java.nio.file.Path

import candela.base.{Problem, SceneError, Severity, SourcePos}
import candela.scenefile.Source

/** The triangles of a PLY file.
  *
  * @param positions x, y, z of each vertex; all finite
  * @param normals   x, y, z of each vertex, of any length; empty if the file has none. What is not
  *                  finite there is 0, which stands for no normal.
  * @param uvs       u, v of each vertex; empty if the file has none
  * @param indices   three vertices for each triangle, each in range
  */
final class PlyMesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val uvs: Array[Float],
    val indices: Array[Int]
)

/** Reads meshes in the polygon file format: ASCII, binary of both byte orders, and either gzipped.
  *
  * Faces of four corners become the triangles 0 1 2 and 3 0 2, as in pbrt-v3; larger ones a fan.
  * Faces of fewer than three corners have no surface and are left out, as is all that is no vertex
  * or face.
  */
object PlyFile:

  /** @param at where a scene asks for the file, for the problem if it can't be read */
  def read(path: Path, at: Option[SourcePos] = None): PlyMesh =
    Source.read(path) match
      case Right(source) => mesh(source.bytes, path.toString, at)
      case Left(why) => throw problem(at, s"can't read the mesh `$path`: $why")

  private def problem(at: Option[SourcePos], message: String): SceneError =
    SceneError(Problem(Severity.Error, at, message))

  private[build] def mesh(bytes: Array[Byte], name: String, at: Option[SourcePos]): PlyMesh =
    var isAscii = true
    def fail(offset: Int, message: String): Nothing =
      val line = 1 + bytes.iterator.take(offset).count(_ == '\n')
      val place = if isAscii then s"line $line" else s"byte $offset"
      throw problem(at, s"mesh `$name`, $place: $message")
    val header = PlyHeader.read(bytes, fail)
    isAscii = header.format == PlyFormat.Ascii
    PlyReader(header, PlyNumbers.of(bytes, header, fail), fail).read()
