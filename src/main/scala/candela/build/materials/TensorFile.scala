package candela.build.materials

import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path}

/** One array of a tensor file.
  *
  * @param kind  1: unsigned bytes; 10: floats; others are not read
  * @param shape how many entries along each dimension, the last fastest
  */
private[build] final class Tensor(val kind: Int, val shape: Vector[Int], bytes: ByteBuffer):
  val length: Int = shape.product

  def floats: Array[Float] = Array.tabulate(length)(i => bytes.getFloat(4 * i))

/** Reads the container of Dupuy and Jakob's measurements: `tensor_file`, a zero, version 1.0, a
  * number of fields, and for each its name, dimensions, type, place in the file, and sizes. All
  * little-endian.
  */
private[build] object TensorFile:
  val Bytes = 1
  val Floats = 10
  private val Magic = "tensor_file\u0000".getBytes("ISO-8859-1")
  private val Sizes = Map(Bytes -> 1, Floats -> 4)

  /** By name; or what is wrong with the file. */
  def read(path: Path): Either[String, Map[String, Tensor]] =
    try Right(fields(ByteBuffer.wrap(Files.readAllBytes(path)).order(ByteOrder.LITTLE_ENDIAN)))
    catch
      case e: java.io.IOException => Left(s"cannot be read: ${e.getMessage}")
      case _: java.nio.BufferUnderflowException => Left("the file ends in the middle")
      case e: Malformed => Left(e.getMessage)

  private final class Malformed(message: String) extends RuntimeException(message)

  private def fields(in: ByteBuffer): Map[String, Tensor] =
    val magic = new Array[Byte](Magic.length)
    val _ = in.get(magic)
    if !magic.sameElements(Magic) then throw Malformed("this is no tensor file")
    val version = (in.get().toInt, in.get().toInt)
    if version != (1, 0) then
      throw Malformed(s"tensor files of version ${version._1}.${version._2} are not known")
    val count = in.getInt()
    if count < 0 || count > 1000 then throw Malformed(s"it claims $count fields")
    Vector.fill(count)(field(in)).toMap

  private def field(in: ByteBuffer): (String, Tensor) =
    val name = new Array[Byte](in.getShort() & 0xffff)
    val _ = in.get(name)
    val dimensions = in.getShort() & 0xffff
    val kind = in.get().toInt
    val offset = in.getLong()
    val word = String(name, "ISO-8859-1")
    if dimensions > 8 then throw Malformed(s"`$word` has $dimensions dimensions")
    val shape = Vector.fill(dimensions)(in.getLong())
    // Products of hostile sizes must not wrap around
    val entries = shape.foldLeft(BigInt(1))(_ * _)
    val size = entries * Sizes.getOrElse(kind, 1)
    if shape.exists(_ < 0) || offset < 0 || offset + size > in.limit() then
      throw Malformed(s"`$word` lies beyond the end of the file")
    val bytes = in.slice(offset.toInt, size.toInt).order(ByteOrder.LITTLE_ENDIAN)
    word -> Tensor(kind, shape.map(_.toInt), bytes)
