package candela.build.shapes

import candela.base.{FloatBuffer, IntBuffer, RestBuffer, loop}
import candela.io.{InputFile, IoReason}
import candela.scenefile.{LineReader, PlacedText, Source}

import java.io.IOException

import scala.collection.mutable

/** Faces that follow each other with one material and smoothing group.
  *
  * @param material  what `usemtl` says
  * @param smoothing number of the group; 0: flat
  */
final case class ObjRun(firstFace: Int, material: Option[PlacedText], smoothing: Int)

/** A mesh of polygons of an OBJ file.
  *
  * @param positions x, y, z of each vertex; all finite
  * @param rests     what `positions` lack of the numbers in the file, as in [[Param.rests]]
  * @param colors    red, green, blue of each vertex; empty: there are none
  * @param normals   not normalised
  * @param corners   of faces: indices of position, coordinates and normal of each, or −1
  * @param ends      of each face: the corner behind its last one
  * @param libraries what `mtllib` says
  * @param omitted   statements that are left out, the first of each kind
  */
final class ObjMesh(
    val positions: Array[Float],
    val rests: Array[Float],
    val colors: Array[Float],
    val normals: Array[Float],
    val uvs: Array[Float],
    val corners: Array[Int],
    val ends: Array[Int],
    val runs: Vector[ObjRun],
    val libraries: Vector[PlacedText],
    val omitted: Vector[PlacedText]
):
  def faces: Int = ends.length

  /** The faces of a run. */
  def facesOf(run: Int): Range =
    runs(run).firstFace until (if run + 1 < runs.size then runs(run + 1).firstFace else faces)

  def start(face: Int): Int = if face == 0 then 0 else ends(face - 1)

  /** Index of the position, the coordinates and the normal of a corner; −1: none. */
  def position(corner: Int): Int = corners(3 * corner)
  def uv(corner: Int): Int = corners(3 * corner + 1)
  def normal(corner: Int): Int = corners(3 * corner + 2)

/** Reads meshes in Wavefront's OBJ format, byte by byte.
  *
  * Source: Wavefront Technologies, "Object Files (.obj)", appendix B1 of the Advanced Visualizer
  * manual, 1995; the colours of vertices are those of MeshLab and Blender.
  */
object ObjFile:

  /** @param fail reports a problem at a line and a column
    *             (0: of the whole file)
    */
  def read(file: InputFile)(fail: (Int, Int, String) => Nothing): ObjMesh =
    Source.read(file) match
      case Left(why) => fail(0, 0, s"can't read it: $why")
      case Right(source) =>
        try ObjReader(LineReader(source, continues = true, file.isShown, fail)).read()
        catch case e: IOException => fail(0, 0, s"can't read it: ${IoReason(e)}")
        finally source.close()

  /** What is left out beside statements. */
  val Slivers = "faces of fewer than three corners"
  val Undefined = "numbers that are undefined"
  def missing(what: String): String = s"indices of $what, of which there are none,"

private final class ObjReader(in: LineReader):
  private val positions, colors, normals, uvs = FloatBuffer()
  private val missing = RestBuffer()
  private val corners, ends = IntBuffer()

  /** Corners of the face that is being read. */
  private val pending = IntBuffer()
  private val runs = mutable.ArrayBuffer.empty[ObjRun]
  private val libraries = mutable.ArrayBuffer.empty[PlacedText]
  private val omitted = mutable.LinkedHashMap.empty[String, PlacedText]
  private val vertices = Later("vertices", isNeeded = true)
  private val coordinates = Later("texture coordinates", isNeeded = false)
  private val directions = Later("normals", isNeeded = false)
  private var material = Option.empty[PlacedText]
  private var smoothing = 0
  private var startsRun = true

  def read(): ObjMesh =
    while in.advance() do if in.hasNext then statement()
    if ends.length == 0 then in.wrongAt(0, 0, s"it has no faces$instead")
    val all = positions.drain()
    vertices.check(all.length / 3)
    val hasUvs = coordinates.check(uvs.length / 2)
    val hasNormals = directions.check(normals.length / 3)
    val cornersRead = corners.drain()
    if !hasUvs then remove(cornersRead, 1)
    if !hasNormals then remove(cornersRead, 2)
    ObjMesh(
      all,
      missing.drain(all.length),
      if colors.length == 0 then Array.emptyFloatArray else colorsOf(all.length),
      normals.drain(),
      uvs.drain(),
      cornersRead,
      ends.drain(),
      runs.toVector,
      libraries.toVector,
      omitted.values.toVector
    )

  private def instead: String =
    if omitted.isEmpty || !in.isShown then "" else omitted.keys.mkString(", only `", "`, `", "`")

  /** Of corners: an index of three. */
  private def remove(corners: Array[Int], kind: Int): Unit =
    loop(corners.length / 3)(c => corners(3 * c + kind) = -1)

  /** Vertices without colours are white. */
  private def colorsOf(count: Int): Array[Float] =
    while colors.length < count do colors += 1f
    colors.drain()

  private def statement(): Unit =
    val (start, column) = (in.mark, in.column)
    val length = in.pass()
    val first = in.byteAt(start)
    length match
      case 1 if first == 'v' => vertex()
      case 1 if first == 'f' => face(column)
      case 2 if first == 'v' && in.byteAt(start + 1) == 'n' => loop(3)(_ => lenient(normals))
      case 2 if first == 'v' && in.byteAt(start + 1) == 't' =>
        lenient(uvs)
        if in.hasNext then lenient(uvs) else uvs += 0f
      case _ => rareStatement(in.textFrom(start), column)

  private def rareStatement(keyword: String, column: Int): Unit = keyword match
    case "usemtl" =>
      material = Some(in.remainder()).filter(_.text.nonEmpty)
      startsRun = true
    case "mtllib" => libraries += in.remainder()
    case "s" =>
      smoothing = if in.hasNext then group() else 0
      startsRun = true
    case "o" | "g" => ()
    case _ => omit(keyword, column)

  private def omit(kind: String, column: Int): Unit =
    if omitted.size < ObjReader.MaxOmitted && !omitted.contains(kind) then
      omitted(kind) = PlacedText(kind, in.line, column)

  private def group(): Int =
    val start = in.mark
    in.word() match
      case "off" => 0
      case "on" => 1
      case text =>
        text.toIntOption.getOrElse:
          in.moveTo(start)
          in.wrong(s"expected the number of a smoothing group or `off`, found ${in.quotedWord}")

  private def vertex(): Unit =
    val vertexIndex = positions.length / 3
    loop(3): _ =>
      val x = in.finite()
      if RestBuffer.isCoarse(x) then missing.note(positions.length, in.exact, x)
      positions += x
    if in.hasNext then
      val weight = in.float()
      if in.hasNext then
        while colors.length < 3 * vertexIndex do colors += 1f
        colors += weight
        colors += in.float()
        colors += in.float()

  /** What is not finite means nothing, as exporters write it. */
  private def lenient(to: FloatBuffer): Unit =
    if in.isUndefined then
      omit(ObjFile.Undefined, in.column)
      val _ = in.pass()
      to += 0f
    else
      val x = in.float()
      to += (if java.lang.Float.isFinite(x) then x else 0f)

  private def face(column: Int): Unit =
    pending.clear()
    while in.hasNext do corner()
    if pending.length < 9 then omit(ObjFile.Slivers, column)
    else
      if startsRun then
        runs += ObjRun(ends.length, material, smoothing)
        startsRun = false
      loop(pending.length)(i => corners += pending(i))
      ends += corners.length / 3

  /** `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or back from the last. */
  private def corner(): Unit =
    val start = in.mark
    val position = index(start, positions.length / 3, vertices)
    if position < 0 then cornerless(start)
    pending += position
    pending += following(start, uvs.length / 2, coordinates)
    pending += following(start, normals.length / 3, directions)
    if !in.isAtEnd then cornerless(start)

  private def cornerless(start: Int): Nothing =
    in.moveTo(start)
    in.wrong(s"expected a face's corner, found ${in.quotedWord}")

  private def following(start: Int, count: Int, kind: Later): Int =
    if in.isAt('/') then
      in.skip(1)
      index(start, count, kind)
    else -1

  /** The index at the cursor, from 0; −1 if there is none. */
  private def index(start: Int, count: Int, kind: Later): Int =
    val isBackward = in.isAt('-')
    if isBackward then in.skip(1)
    val digits = in.mark
    val n = in.digits()
    if in.mark == digits then if isBackward then cornerless(start) else -1
    else
      val resolved = if isBackward then count - n else n - 1
      if resolved < 0 || resolved == Int.MaxValue then
        in.moveTo(start)
        in.wrong(kind.outOfRange(in.quotedWord, count))
      if resolved >= count then kind.note(resolved.toInt, start)
      resolved.toInt

  /** Indices of what the file may still bring: the largest, and how it is reported. */
  private final class Later(val plural: String, isNeeded: Boolean):
    private var maxIndex = -1
    private var report: Int => Nothing = _ => in.wrong(plural)
    private var record = PlacedText(ObjFile.missing(plural), 0, 0)

    def outOfRange(word: String, count: Int): String =
      val range = if count == 0 then s"there are no $plural" else s"$plural are 1 to $count"
      s"an index of the corner $word is out of range: $range"

    def note(index: Int, start: Int): Unit = if index > maxIndex then
      val end = in.mark
      in.moveTo(start)
      val (line, column, word) = (in.line, in.column, in.quotedWord)
      in.moveTo(end)
      maxIndex = index
      record = record.copy(line = line, column = column)
      report = count =>
        in.wrongAt(line, column, outOfRange(word, count))

    /** False if the indices are of what the file has none of, and needs not. */
    def check(count: Int): Boolean =
      val isSound = maxIndex < count
      if !isSound then
        if isNeeded || count > 0 then report(count)
        omitted(record.text) = record
      isSound

private object ObjReader:
  /** Kinds of statements that are left out. */
  private val MaxOmitted = 50
