package candela.models

import candela.base.{indexWhere, loop}
import candela.diagnostics.{Code, Limit}

import java.nio.ByteBuffer

import scala.collection.mutable

/** Numbers of a model: plain or normalised, dense or sparse; each accessor is read once.
  *
  * Source: glTF 2.0 specification, §3.6.2.
  */
private[models] final class Accessors(file: GltfFile, session: Session):
  private val all = file.root.list("accessors")
  private val floatArrays = mutable.HashMap.empty[Int, Array[Float]]
  private val intArrays = mutable.HashMap.empty[Int, Array[Int]]

  def entry(index: Json): Json = index.element(all, "accessors")

  /** Components of each element. */
  def components(index: Json): Int =
    val kind = entry(index).required("type")
    Accessors.Components.getOrElse(kind.text, kind.fail(s"unknown type `${kind.text}`"))

  /** The numbers of vectors of so many components. */
  def floats(index: Json, each: Int): Array[Float] =
    val count = components(index)
    if count != each then entry(index).fail(s"expected $each components, found $count")
    floats(index)

  def floats(index: Json): Array[Float] =
    floatArrays.getOrElseUpdate(
      index.size, {
        val a = entry(index)
        val maxValue = if a.flag("normalized") then kindOf(a).maxValue else 0.0
        val out = new Array[Float](checkedSize(a, components(index)))
        read(a, components(index)): (i, x) =>
          out(i) = (if maxValue > 0 then Math.max(x / maxValue, -1.0) else x).toFloat
        indexWhere(out.length)(i => !java.lang.Float.isFinite(out(i))) match
          case -1 => out
          case i => a.fail(s"number $i is ${out(i)}")
      }
    )

  def ints(index: Json): Array[Int] =
    intArrays.getOrElseUpdate(
      index.size, {
        val a = entry(index)
        val out = new Array[Int](checkedSize(a, components(index)))
        read(a, components(index)): (i, x) =>
          if x != x.toInt then a.fail(s"number $i is $x, not an index")
          out(i) = x.toInt
        out
      }
    )

  /** Numbers in all, which must be in the file or of a reasonable count. */
  private def checkedSize(a: Json, each: Int): Int =
    val size = a.required("count").size.toLong * each
    session.folder.allowance.check(Limit.Triangles, size / 9, Some(a.at))(s"$size numbers")
    if a("bufferView").isEmpty && size > Accessors.MaxImplied then
      Session.fail(a.at, s"$size numbers that are in no buffer", Code.TooLarge)
    if size > Int.MaxValue - 8 then Session.fail(a.at, s"$size numbers", Code.TooLarge)
    for index <- a("bufferView") do
      val kind = kindOf(a)
      val stride = strideOf(a, index, each * kind.bytes)
      val elements = a.required("count").size.toLong
      val end = a.size("byteOffset", 0) + (elements - 1) * stride + each * kind.bytes
      val bytes = file.view(index).remaining
      if elements > 0 && end > bytes then
        a.fail(s"$elements elements end at byte $end of a buffer view of $bytes bytes")
    session.folder.allowance.countBytes(4 * size, session.file, Some(a.at))
    size.toInt

  private def kindOf(a: Json): Number =
    val code = a.required("componentType")
    Number.all.find(_.code == code.int).getOrElse(code.fail(s"unknown component type ${code.int}"))

  private def strideOf(a: Json, view: Json, element: Int): Int =
    val stride = file.stride(view).getOrElse(element)
    if stride < element then a.fail(s"elements of $element bytes are $stride bytes apart")
    stride

  /** Visits all numbers, those that a sparse accessor replaces last. */
  private inline def read(a: Json, each: Int)(inline visit: (Int, Double) => Unit): Unit =
    val kind = kindOf(a)
    val element = each * kind.bytes
    val count = a.required("count").size
    for index <- a("bufferView") do
      val (bytes, stride) = (file.view(index), strideOf(a, index, element))
      val start = a.size("byteOffset", 0)
      loop(count): i =>
        loop(each): c =>
          visit(i * each + c, kind.number(bytes, start + i * stride + c * kind.bytes))
    for sparse <- a("sparse") do
      val changed = sparse.required("count").size
      val (indices, values) = (sparse.required("indices"), sparse.required("values"))
      val indexKind = kindOf(indices)
      val changedIndices = part(indices, changed.toLong * indexKind.bytes)
      val numbers = part(values, changed.toLong * element)
      loop(changed): k =>
        val i = indexKind.number(changedIndices, k * indexKind.bytes)
        if i < 0 || i >= count then indices.fail(s"index $k is ${i.toLong}, of $count elements")
        loop(each): c =>
          visit(i.toInt * each + c, kind.number(numbers, k * element + c * kind.bytes))

  private def part(a: Json, length: Long): ByteBuffer =
    val bytes = file.view(a.required("bufferView"))
    val from = a.size("byteOffset", 0)
    if from + length > bytes.remaining then
      a.fail(s"bytes $from to ${from + length} of a buffer view of ${bytes.remaining} bytes")
    bytes.slice(from, length.toInt).order(bytes.order)

private[models] object Accessors:
  val Components: Map[String, Int] =
    Map(
      "SCALAR" -> 1,
      "VEC2" -> 2,
      "VEC3" -> 3,
      "VEC4" -> 4,
      "MAT2" -> 4,
      "MAT3" -> 9,
      "MAT4" -> 16
    )

  /** Numbers that an accessor without a buffer may have. */
  val MaxImplied = 1L << 26

/** Types of numbers in buffers.
  *
  * @param maxValue what stands for 1 if it is normalised; 0: it can't be
  */
private[models] enum Number(val code: Int, val bytes: Int, val maxValue: Double):
  case Int8 extends Number(5120, 1, 127)
  case UInt8 extends Number(5121, 1, 255)
  case Int16 extends Number(5122, 2, 32767)
  case UInt16 extends Number(5123, 2, 65535)
  case UInt32 extends Number(5125, 4, 0)
  case Float32 extends Number(5126, 4, 0)

  def number(b: ByteBuffer, at: Int): Double = this match
    case Int8 => b.get(at)
    case UInt8 => b.get(at) & 0xff
    case Int16 => b.getShort(at)
    case UInt16 => b.getShort(at) & 0xffff
    case UInt32 => (b.getInt(at) & 0xffffffffL).toDouble
    case Float32 => b.getFloat(at)

private[models] object Number:
  val all: Vector[Number] = values.toVector
