package candela.models.assimp

import org.lwjgl.PointerBuffer
import org.lwjgl.system.MemoryUtil

import java.nio.{ByteBuffer, ByteOrder}

import scala.collection.mutable

/** Accessors of glTF, each with a buffer and a view of its own. What Assimp has is not copied. */
private[assimp] final class Arrays:
  private val buffers, views, accessors = mutable.ArrayBuffer.empty[ujson.Obj]
  private val contents = mutable.ArrayBuffer.empty[ByteBuffer]

  def buffer(index: Int): ByteBuffer = contents(index)
  def members: Seq[(String, ujson.Value)] = Seq(
    "buffers" -> ujson.Arr.from(buffers),
    "bufferViews" -> ujson.Arr.from(views),
    "accessors" -> ujson.Arr.from(accessors)
  )

  private def add(bytes: ByteBuffer, component: Int, kind: String, count: Int, stride: Int): Int =
    val index = accessors.size
    val length = ujson.Num(bytes.remaining.toDouble)
    contents += bytes
    buffers += ujson.Obj("byteLength" -> length)
    views += ujson.Obj("buffer" -> index, "byteLength" -> length)
    if stride > 0 then views.last("byteStride") = stride
    accessors +=
      ujson.Obj(
        "bufferView" -> index,
        "componentType" -> component,
        "type" -> kind,
        "count" -> count
      )
    index

  def floats(kind: String, count: Int, values: Iterator[Float]): Int =
    val bytes = Arrays.allocate(count * Arrays.Components(kind))
    values.foreach(bytes.putFloat(_): Unit)
    add(bytes.flip(), Arrays.Float32, kind, count, 0)

  def ints(kind: String, count: Int, values: Iterator[Int]): Int =
    val bytes = Arrays.allocate(count * Arrays.Components(kind))
    values.foreach(bytes.putInt(_): Unit)
    add(bytes.flip(), Arrays.UInt32, kind, count, 0)

  /** The first components of vectors of three floats in native memory. */
  def native(kind: String, count: Int, address: Long): Int =
    add(MemoryUtil.memByteBuffer(address, 12 * count), Arrays.Float32, kind, count, 12)

private[assimp] object Arrays:
  private val Float32 = 5126
  private val UInt32 = 5125
  private val Components = Map("SCALAR" -> 1, "VEC3" -> 3, "VEC4" -> 4, "MAT4" -> 16)

  private def allocate(numbers: Int): ByteBuffer =
    ByteBuffer.allocate(Math.multiplyExact(4, numbers)).order(ByteOrder.LITTLE_ENDIAN)

  /** The structures that pointers lead to. */
  def all[A](pointers: PointerBuffer | Null)(at: Long => A): Vector[A] =
    if pointers == null then Vector.empty
    else Vector.tabulate(pointers.remaining)(i => at(pointers.get(i)))
