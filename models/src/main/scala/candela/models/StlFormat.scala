package candela.models

import candela.base.{FloatBuffer, IntBuffer, loop}
import candela.build.shapes.CornerVertices
import candela.diagnostics.{Code, Limit, SourcePos}
import candela.io.{ForeignFile, InputFile, IoReason}
import candela.scenefile.{LineReader, SceneDescription, Source}
import candela.settings.UpAxis

import java.io.IOException
import java.lang.Float.{floatToRawIntBits, intBitsToFloat}
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.util.Locale

/** Models in the format of stereolithography, as scenes. */
final class StlFormat extends MeshFormat("STL", "stl", UpAxis.Z):

  private[models] def surfaces(input: InputFile, session: Session): SceneDescription =
    Source.read(input) match
      case Left(why) =>
        Session.fail(session.position, s"can't read the model: $why", Code.Unreadable)
      case Right(source) =>
        try
          val triangles = StlTriangles()
          if StlFormat.isText(source) then StlText(source, input, session, triangles).read()
          else StlBinary(source, session, triangles).read()
          MeshFormat.scene(triangles.mesh(), session)
        catch
          case e: IOException =>
            Session.fail(
              session.position,
              s"can't read the model: ${IoReason(e)}",
              Code.Unreadable
            )
        finally source.close()

private object StlFormat:
  /** Binary files may begin with `solid`, too, but their numbers have bytes that no text has. */
  private def isText(source: Source): Boolean =
    val start = source.bytes.take(Math.min(source.limit, ForeignFile.Head)).drop(source.start)
    String(start, ISO_8859_1).stripLeading.toLowerCase(Locale.ROOT).startsWith("solid") &&
    !start.exists(b => b >= 0 && b < ' ' && !Character.isWhitespace(b.toChar))

/** Triangles that are being read. Vertices at one point are one, unless triangles have colours. */
private final class StlTriangles:
  private val vertices = CornerVertices()
  private val indices = IntBuffer()
  private val colors = FloatBuffer()

  def size: Int = indices.length / 3

  def add(x: Float, y: Float, z: Float): Unit =
    // + 0 makes one of both zeros
    indices += vertices(
      floatToRawIntBits(x + 0f),
      floatToRawIntBits(y + 0f),
      floatToRawIntBits(z + 0f)
    )

  /** The linear colour of the next triangle; if one has one, all have. */
  def color(r: Float, g: Float, b: Float): Unit =
    colors += r
    colors += g
    colors += b
    colors += 1f

  def mesh(): Mesh =
    val points = Array.tabulate(3 * vertices.size): i =>
      intBitsToFloat(i % 3 match
        case 0 => vertices.first(i / 3)
        case 1 => vertices.second(i / 3)
        case _ => vertices.third(i / 3))
    val triangles = Mesh(points, indices.drain())
    if colors.length == 0 then triangles else triangles.coloredByTriangle(colors.drain())

/** Reads text: only the vertices of each facet matter. */
private final class StlText(
    source: Source,
    input: InputFile,
    session: Session,
    triangles: StlTriangles
):
  private val in = LineReader(source, continues = false, input.isShown, fail)

  private def fail(line: Int, column: Int, message: String): Nothing =
    Session.fail(SourcePos(s"${session.file}", line, column), message)

  def read(): Unit =
    var corners = 0
    var isOpen = false
    while in.advance() do
      while in.hasNext do
        val start = in.mark
        in.word().toLowerCase(Locale.ROOT) match
          case "vertex" =>
            triangles.add(in.finite(), in.finite(), in.finite())
            corners += 1
          case "facet" =>
            corners = 0
            isOpen = true
          case "endfacet" =>
            if corners != 3 then in.wrong(s"expected a facet of three vertices, found $corners")
            isOpen = false
          // Some programs write normals that are no numbers
          case "normal" => loop(3)(_ => if in.hasNext then in.word(): Unit)
          case "solid" | "endsolid" => in.remainder(): Unit
          case "outer" | "loop" | "endloop" => ()
          case _ =>
            in.moveTo(start)
            in.wrong(s"expected a statement of STL such as `vertex`, found ${in.quotedWord}")
    if isOpen then in.wrong("the file ends within a facet")

/** Reads binary files: a header of 80 bytes, the number of triangles, and 50 bytes for each. */
private final class StlBinary(source: Source, session: Session, triangles: StlTriangles):
  private var cursor = 0

  private def fail(message: String): Nothing = Session.fail(session.position, message)

  /** Whether so many bytes follow the cursor. */
  private def hasBytes(count: Int): Boolean =
    if source.limit - cursor < count && !source.isLast then
      source.slide(cursor)
      cursor = 0
    source.limit - cursor >= count

  private def int(at: Int): Int =
    val b = source.bytes
    b(at) & 0xff | (b(at + 1) & 0xff) << 8 | (b(at + 2) & 0xff) << 16 | b(at + 3) << 24

  def read(): Unit =
    if !hasBytes(StlBinary.Header + 4) then
      fail("expected an STL file: text that begins with `solid`, or binary of 84 bytes and more")
    val header = String(source.bytes, 0, StlBinary.Header, ISO_8859_1)
    val count = int(StlBinary.Header) & 0xffffffffL
    cursor = StlBinary.Header + 4
    if count * StlBinary.Facet > source.maxAfter(cursor) then
      val bytes = source.maxAfter(cursor)
      fail(s"the file is too short for its $count triangles: $bytes bytes follow the header")
    session.folder.allowance.check(Limit.Triangles, count, Some(session.position)):
      s"the model has $count triangles"
    val defaultColor = StlBinary.materialise(header)
    val attributes = IntBuffer()
    loop(count.toInt)(facet(_, attributes))
    if attributes.length < count then fail(s"the file ends after ${triangles.size} triangles")
    addColors(attributes, defaultColor)

  private def facet(index: Int, attributes: IntBuffer): Unit =
    if hasBytes(StlBinary.Facet) then
      loop(3): corner =>
        val at = cursor + 12 * (corner + 1)
        val (x, y, z) =
          (intBitsToFloat(int(at)), intBitsToFloat(int(at + 4)), intBitsToFloat(int(at + 8)))
        if !(Math.abs(x) <= Float.MaxValue && Math.abs(y) <= Float.MaxValue &&
            Math.abs(z) <= Float.MaxValue)
        then fail(s"expected finite numbers, found $x $y $z in triangle ${index + 1}")
        triangles.add(x, y, z)
      val end = cursor + 48
      attributes += (source.bytes(end) & 0xff | (source.bytes(end + 1) & 0xff) << 8)
      cursor += StlBinary.Facet

  /** Those of Materialise, or of VisCAM and SolidView, which disagree in order and flag. */
  private def addColors(attributes: IntBuffer, defaultColor: Option[(Float, Float, Float)]): Unit =
    def component(bits: Int, shift: Int) = MeshFormat.linear(((bits >> shift) & 31) / 31f)
    val areFlagged = (0 until attributes.length).exists(i => (attributes(i) & 0x8000) != 0)
    defaultColor match
      case Some((r, g, b)) =>
        loop(attributes.length): i =>
          val bits = attributes(i)
          if (bits & 0x8000) != 0 then triangles.color(r, g, b)
          else triangles.color(component(bits, 0), component(bits, 5), component(bits, 10))
      case None if areFlagged =>
        loop(attributes.length): i =>
          val bits = attributes(i)
          if (bits & 0x8000) == 0 then
            triangles.color(MeshFormat.Gray, MeshFormat.Gray, MeshFormat.Gray)
          else triangles.color(component(bits, 10), component(bits, 5), component(bits, 0))
      case None => ()

private object StlBinary:
  // In bytes
  val Header = 80
  val Facet = 50

  /** The colour of the model, by the header that Materialise's programs write. */
  private def materialise(header: String): Option[(Float, Float, Float)] =
    val start = header.indexOf("COLOR=")
    Option.when(start >= 0 && start + 9 < header.length):
      def component(i: Int) = MeshFormat.linear((header(start + 6 + i) & 0xff) / 255f)
      (component(0), component(1), component(2))
