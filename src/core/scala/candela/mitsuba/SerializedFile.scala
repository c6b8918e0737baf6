package candela.mitsuba

import candela.base.{FloatBuffer, IntBuffer, RestBuffer}
import candela.diagnostics.{Code, SourcePos}
import candela.io.{InputFile, IoReason}
import java.io.{ByteArrayInputStream, EOFException, IOException, InputStream}
import java.nio.{ByteBuffer, ByteOrder}
import java.util.zip.InflaterInputStream

/** Reads Mitsuba's `.serialized` meshes, versions 3 and 4.
  *
  * A file holds compressed meshes, then the offset of each, then their number.
  */
object SerializedFile:

  /** @param index which of the meshes
    * @param at    position of the reference in the scene
    */
  def read(from: InputFile, index: Int, at: SourcePos): Mesh =
    def fail(reason: String) =
      Values.fail(Code.DamagedMesh, at, s"can't read the mesh `$from`: $reason")
    try
      val file = from.map().order(ByteOrder.LITTLE_ENDIAN)
      if file.limit() < 8 || file.getShort(0) != Magic then fail("it is not a serialized mesh")
      val version = file.getShort(2).toInt
      if version != 3 && version != 4 then fail(s"version $version is not known")
      val (start, end) = meshRange(file, index, if version == 4 then 8 else 4, fail)
      val bytes = new Array[Byte](end - start - 4)
      file.position(start + 4).get(bytes): Unit
      new SerializedReader(bytes, version, from.unpacks, fail).read()
    catch
      case e: IOException => fail(IoReason(e))

  private val Magic: Short = 0x041c

  /** Where a mesh begins and ends. */
  private def meshRange(
      file: ByteBuffer,
      index: Int,
      width: Int,
      fail: String => Nothing
  ): (Int, Int) =
    val count = file.getInt(file.limit() - 4)
    val table = file.limit() - 4 - count.toLong * width
    if count < 1 || table < 4 then fail("its list of meshes is damaged")
    if index < 0 || index >= count then fail(s"it has $count meshes; there is no number $index")
    def offset(i: Int): Long =
      val position = (table + i.toLong * width).toInt
      if i == count then table
      else if width == 8 then file.getLong(position)
      else file.getInt(position) & 0xffffffffL
    val (from, to) = (offset(index), offset(index + 1))
    if from < 0 || to - from < 4 || to > table then fail("its list of meshes is damaged")
    (from.toInt, to.toInt)

private final class SerializedReader(
    bytes: Array[Byte],
    version: Int,
    unpacks: Long => Unit,
    fail: String => Nothing
):
  private val input: InputStream = InflaterInputStream(ByteArrayInputStream(bytes))
  private val buffer = ByteBuffer.allocate(1 << 15).order(ByteOrder.LITTLE_ENDIAN).flip()

  def read(): Mesh =
    val flags = int()
    if version == 4 then skipName()
    val (vertices, triangles) = (count(), count())
    val isDouble = (flags & 0x2000) != 0
    val perVertex = 3 + (if (flags & 1) != 0 then 3 else 0) + (if (flags & 2) != 0 then 2 else 0)
    val size = vertices.toLong * perVertex * (if isDouble then 8 else 4) + triangles * 12L
    if size > SerializedReader.TrustedSize && size > bytes.length * SerializedReader.MaxCompression
    then
      fail(s"it claims $vertices vertices and $triangles triangles, more than it can hold")
    unpacks(size)
    val rests = RestBuffer()
    def values(n: Long, isPresent: Boolean, missing: RestBuffer | Null = null) =
      val floats = FloatBuffer()
      var i = 0L
      while isPresent && i < n do
        if isDouble then
          val x = buffered(8).getDouble
          if missing != null && RestBuffer.isCoarse(x.toFloat) then
            missing.note(floats.length, x, x.toFloat)
          floats += x.toFloat
        else floats += buffered(4).getFloat
        i += 1
      floats.drain()
    val positions = values(3L * vertices, true, rests)
    val normals = values(3L * vertices, (flags & 1) != 0)
    val uvs = values(2L * vertices, (flags & 2) != 0)
    val _ = values(3L * vertices, (flags & 8) != 0)
    val indices = IntBuffer()
    var i = 0L
    while i < 3L * triangles do
      val index = int()
      if index < 0 || index >= vertices then fail(s"the index $index is not below $vertices")
      indices += index
      i += 1
    if !positions.forall(_.isFinite) then fail("a position is not finite")
    val finite = normals.map(x => if x.isFinite then x else 0f)
    Mesh(positions, finite, uvs, indices.drain(), rests.drain(positions.length))

  private def skipName(): Unit =
    var length = 0
    while buffered(1).get != 0 do
      length += 1
      if length > 10000 then fail("its name has no end")

  private def int(): Int = buffered(4).getInt

  private def count(): Int =
    val n = buffered(8).getLong
    if n < 1 || n > Int.MaxValue / 3 then fail(s"it claims $n vertices or triangles")
    n.toInt

  private def buffered(size: Int): ByteBuffer =
    if buffer.remaining < size then
      buffer.compact()
      var read = 0
      while buffer.position() < size && read >= 0 do
        read = input.read(buffer.array, buffer.position(), buffer.remaining)
        if read > 0 then buffer.position(buffer.position() + read): Unit
      buffer.flip()
      if buffer.remaining < size then throw EOFException()
    buffer

private object SerializedReader:
  /** Size in bytes below which any compression is believed. */
  private val TrustedSize = 64L << 20

  /** Meshes compress 2 to 10 times. */
  private val MaxCompression = 100L
