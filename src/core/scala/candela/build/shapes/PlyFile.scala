package candela.build.shapes

import candela.base.loop
import candela.diagnostics.{Code, Problem, SceneError, Severity, SourcePos}
import candela.io.{InputFile, IoReason}
import java.io.IOException

import candela.math.{Position, Transform}
import candela.scenefile.{PlacedText, Source}

/** Mesh of a PLY file.
  *
  * @param positions x, y, z of each vertex; all finite
  * @param rests     what `positions` lack of the numbers in the file, as in [[Param.rests]]
  * @param normals   x, y, z of each vertex, not normalised; empty if the file has none. Components
  *                  that are not finite are 0, which means no normal.
  * @param uvs       u, v of each vertex; empty if the file has none
  * @param indices   three vertex indices per triangle, all in range
  * @param quads     four vertex indices per quad that was kept, in the order 0 1 3 2 of its corners
  * @param ofVertices other numbers of each vertex, by property, in their order; if asked for
  * @param ofTriangles likewise, of the faces that triangles are parts of
  * @param cornerUvs u, v of each of `indices`, if faces have their own
  * @param images    names of image files
  * @param wholes    what stands for 1 in those numbers that are unsigned bytes or words
  * @param omitted   properties and elements that are not read
  */
final class PlyMesh(
    val positions: Array[Float],
    val normals: Array[Float],
    val uvs: Array[Float],
    val indices: Array[Int],
    val quads: Array[Int],
    val ofVertices: Vector[(String, Array[Float])] = Vector.empty,
    val ofTriangles: Vector[(String, Array[Float])] = Vector.empty,
    val rests: Array[Float] = Array.emptyFloatArray,
    val wholes: Map[String, Float] = Map.empty,
    val omitted: Vector[String] = Vector.empty,
    val cornerUvs: Array[Float] = Array.emptyFloatArray,
    val images: Vector[PlacedText] = Vector.empty
):
  /** Around another point, if digits of the vertices would be missing in the world. */
  def recentred(toWorld: Transform): Option[(PlyMesh, Position)] =
    FarPoints.middle(positions, rests, toWorld).map: origin =>
      val points = FarPoints.relative(positions, rests, origin)
      (PlyMesh(points, normals, uvs, indices, quads, ofVertices, ofTriangles), origin)

/** Reads meshes in the polygon file format: ASCII, binary of both byte orders, and either gzipped.
  *
  * Quads become the triangles 0 1 2 and 3 0 2, as in pbrt-v3; larger faces a fan. Faces of fewer
  * than three corners are skipped, as are elements other than vertices and faces. In files that are
  * models, faces may be concave or have texture coordinates, and strips stand for missing faces.
  */
object PlyFile:

  /** @param at        position of the reference in the scene, for error messages
    * @param keepQuads whether to keep quads as they are
    * @param keepsAll  whether to keep all numbers of vertices and faces
    * @param isModel   whether the file is a model of its own
    */
  def read(
      file: InputFile,
      at: Option[SourcePos] = None,
      keepQuads: Boolean = false,
      keepsAll: Boolean = false,
      isModel: Boolean = false
  ): PlyMesh =
    Source.read(file) match
      case Right(source) => mesh(source, at, keepQuads, keepsAll, isModel)
      case Left(why) => throw problem(at, s"can't read the mesh `$file`: $why")

  /** Positions of the first vertices, at most `limit`. */
  def firstPositions(file: InputFile, limit: Int): Array[Double] =
    def fail(at: Long, message: String) = throw problem(None, message)
    Source.read(file) match
      case Left(why) => fail(0, why)
      case Right(source) =>
        try
          val header = PlyHeader.read(source, fail)
          PlyReader(
            header,
            PlyNumbers.of(source, header, fail),
            fail = fail
          ).firstPositions(limit)
        finally source.close()

  private def problem(at: Option[SourcePos], message: String): SceneError =
    SceneError(Problem(Code.DamagedMesh, Severity.Error, at, message))

  private[build] def mesh(
      source: Source,
      at: Option[SourcePos],
      keepQuads: Boolean = false,
      keepsAll: Boolean = false,
      isModel: Boolean = false
  ): PlyMesh =
    var isAscii = true
    def fail(offset: Long, message: String): Nothing =
      val location = if isAscii then s"line ${lineOf(offset, source)}" else s"byte $offset"
      throw problem(at, s"mesh `${source.name}`, $location: $message")
    try
      val header = PlyHeader.read(source, fail)
      isAscii = header.format == PlyFormat.Ascii
      val numbers = PlyNumbers.of(source, header, fail)
      PlyReader(header, numbers, keepQuads, keepsAll, isModel, fail).read()
    catch
      case e: IOException =>
        throw problem(at, s"can't read the mesh `${source.name}`: ${IoReason(e)}")
    finally source.close()

  /** Finds the line of an offset by reading the file again. */
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
