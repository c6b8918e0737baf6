package candela.build.shapes

import java.io.IOException
import java.nio.file.Path

import candela.base.{loop, Problem, SceneError, Severity, SourcePos}
import candela.scenefile.Source

/** The triangles of a PLY file.
  *
  * @param positions x, y, z of each vertex; all finite
  * @param normals   x, y, z of each vertex, of any length; empty if the file has none. What is not
  *                  finite there is 0, which stands for no normal.
  * @param uvs       u, v of each vertex; empty if the file has none
  * @param indices   three vertices for each triangle, each in range
  * @param quads     four vertices for each face of four corners that was left whole, in the order
  *                  0 1 3 2 of its corners
  */
final class PlyMesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val uvs: Array[Float],
    val indices: Array[Int],
    val quads: Array[Int]
)

/** Reads meshes in the polygon file format: ASCII, binary of both byte orders, and either gzipped.
  *
  * Faces of four corners become the triangles 0 1 2 and 3 0 2, as in pbrt-v3; larger ones a fan.
  * Faces of fewer than three corners have no surface and are left out, as is all that is no vertex
  * or face.
  */
object PlyFile:

  /** @param at        where a scene asks for the file, for the problem if it can't be read
    * @param keepQuads leave faces of four corners whole
    */
  def read(path: Path, at: Option[SourcePos] = None, keepQuads: Boolean = false): PlyMesh =
    Source.read(path) match
      case Right(source) => mesh(source, at, keepQuads)
      case Left(why) => throw problem(at, s"can't read the mesh `$path`: $why")

  private def problem(at: Option[SourcePos], message: String): SceneError =
    SceneError(Problem(Severity.Error, at, message))

  private[build] def mesh(
      source: Source,
      at: Option[SourcePos],
      keepQuads: Boolean = false
  ): PlyMesh =
    var isAscii = true
    def fail(offset: Long, message: String): Nothing =
      val place = if isAscii then s"line ${lineOf(offset, source)}" else s"byte $offset"
      throw problem(at, s"mesh `${source.name}`, $place: $message")
    try
      val header = PlyHeader.read(source, fail)
      isAscii = header.format == PlyFormat.Ascii
      PlyReader(header, PlyNumbers.of(source, header, fail), keepQuads, fail).read()
    catch
      case e: IOException =>
        val why = Option(e.getMessage).getOrElse(e.toString)
        throw problem(at, s"mesh `${source.name}`: reading stops: $why")
    finally source.close()

  /** Goes through the file once more. */
  private def lineOf(offset: Long, source: Source): Long =
    var line = 1L
    for again <- source.again do
      try
        while again.offset(again.limit) < offset && !again.isLast do
          line += count(again, again.limit)
          again.slide(again.limit)
        line += count(again, (offset - again.offset(0)).min(again.limit).toInt)
      finally again.close()
    line

  private def count(source: Source, until: Int): Int =
    var lines = 0
    loop(until)(i => if source.bytes(i) == '\n' then lines += 1)
    lines
