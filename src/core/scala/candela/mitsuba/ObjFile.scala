package candela.mitsuba

import candela.base.{Decimal, FloatBuffer, IntBuffer, RestBuffer, loop}
import candela.diagnostics.{Code, SourcePos}
import candela.io.{InputFile, IoReason}
import java.io.IOException
import java.nio.ByteBuffer

import scala.collection.mutable

/** Reads meshes in Wavefront's OBJ format: vertices, normals, coordinates and faces; everything
  * else is ignored. Faces of more than three corners become fans.
  */
object ObjFile:

  /** @param flipped whether v in the file has its origin at the bottom of images
    * @param at      position of the reference in the scene
    */
  def read(file: InputFile, flipped: Boolean, at: SourcePos): Mesh =
    try new ObjReader(file.map(), file, at).read(flipped)
    catch
      case e: IOException =>
        Values.fail(Code.DamagedMesh, at, s"can't read the mesh `$file`: ${IoReason(e)}")

private final class ObjReader(in: ByteBuffer, file: InputFile, at: SourcePos):
  private val p, n, t = FloatBuffer()
  private val positions, normals, uvs = FloatBuffer()
  private val indices = IntBuffer()

  /** Rounding errors of `p`, and the vertex of `p` of each vertex of the mesh. */
  private val missing = RestBuffer()
  private val vertices = IntBuffer()

  /** Index of each corner: position, coordinates, normal. */
  private val corners = mutable.HashMap.empty[(Int, Int, Int), Int]
  private var line = 1
  private var hasNormals, hasUvs = true
  private val token = StringBuilder()

  private def fail(reason: String): Nothing =
    Values.fail(Code.DamagedMesh, at, s"mesh `$file`, line $line: $reason")

  def read(flipped: Boolean): Mesh =
    while in.hasRemaining do
      word() match
        case "v" => numbers(p, 3)
        case "vn" => numbers(n, 3)
        case "vt" => numbers(t, 2)
        case "f" => face()
        case _ => ()
      skipLine()
    val uv = if hasUvs then uvs.drain() else Array.emptyFloatArray
    if flipped then loop(uv.length / 2)(i => uv(2 * i + 1) = 1 - uv(2 * i + 1))
    val normal = if hasNormals then normals.drain() else Array.emptyFloatArray
    if indices.length == 0 then fail("it has no faces")
    val rests = missing.drain(p.length)
    def spread = vertices.drain().flatMap(v => rests.slice(3 * v, 3 * v + 3))
    Mesh(positions.drain(), normal, uv, indices.drain(), if rests.isEmpty then rests else spread)

  /** The next word of the line; empty at its end. */
  private def word(): String =
    token.clear()
    var c = skipBlanks()
    while c > ' ' do
      token.append(c.toChar)
      if token.length > 200 then fail("a word of more than 200 characters")
      val _ = in.get()
      c = peek
    token.result()

  private def peek: Int = if in.hasRemaining then in.get(in.position()) & 0xff else '\n'

  private def skipBlanks(): Int =
    while in.hasRemaining && (peek == ' ' || peek == '\t') do
      val _ = in.get()
    peek

  private def skipLine(): Unit =
    while in.hasRemaining && peek != '\n' do
      val _ = in.get()
    if in.hasRemaining then
      val _ = in.get()
    line += 1

  private def numbers(to: FloatBuffer, count: Int): Unit =
    loop(count): _ =>
      val text = word()
      val x = Decimal.float(text).getOrElse(fail(s"expected a number, found ${file.quoted(text)}"))
      if !x.isFinite then fail(s"expected a finite number, found ${file.quoted(text)}")
      if (to eq p) && RestBuffer.isCoarse(x) then missing.note(p.length, text.toDouble, x)
      to += x

  private def face(): Unit =
    val apex = corner(word())
    var previous = corner(word())
    var text = word()
    while text.nonEmpty do
      val current = corner(text)
      indices += apex
      indices += previous
      indices += current
      previous = current
      text = word()

  private def cornerless(text: String): String =
    s"expected a face's corner, found ${file.quoted(text)}"

  /** `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or back from the last. */
  private def corner(text: String): Int =
    val fields = text.split('/')
    def index(i: Int, count: Int): Int =
      if i >= fields.length || fields(i).isEmpty then -1
      else
        val k = fields(i).toIntOption.getOrElse(fail(cornerless(text)))
        val resolved = if k < 0 then count + k else k - 1
        if resolved < 0 || resolved >= count then fail(s"the index $k is not one of 1 to $count")
        resolved
    val key = (index(0, p.length / 3), index(1, t.length / 2), index(2, n.length / 3))
    if key._1 < 0 then fail(cornerless(text))
    corners.getOrElseUpdate(
      key, {
        val (vertex, uv, normal) = key
        vertices += vertex
        loop(3)(k => positions += p(3 * vertex + k))
        if uv < 0 then hasUvs = false
        loop(2)(k => uvs += (if uv < 0 then 0f else t(2 * uv + k)))
        if normal < 0 then hasNormals = false
        loop(3)(k => normals += (if normal < 0 then 0f else n(3 * normal + k)))
        positions.length / 3 - 1
      }
    )
