package candela.models

import candela.base.loop

import java.nio.{ByteBuffer, ByteOrder}

/** A stream that can't be decoded; the message says why. */
private[models] final class DamagedStream(message: String)
    extends RuntimeException(message, null, false, false)

/** Decodes buffer views that are compressed by meshoptimizer.
  *
  * Source: KHR_meshopt_compression, appendices A and B; EXT_meshopt_compression is version 0 of its
  * attributes, without colours.
  */
private[models] object Meshopt:

  /** The bytes of `count` elements of `stride` bytes.
    *
    * @throws DamagedStream if the data, or what is asked of it, is wrong
    */
  def decode(data: Array[Byte], count: Int, stride: Int, mode: String, filter: String): ByteBuffer =
    val out = mode match
      case "ATTRIBUTES" =>
        check(stride % 4 == 0 && stride >= 4 && stride <= 256, s"attributes of $stride bytes")
        MeshoptAttributes(data, stride).decoded(count)
      case "TRIANGLES" =>
        check(count % 3 == 0, s"triangles of $count indices")
        ofIndices(MeshoptIndices(data).triangles(count), stride)
      case "INDICES" => ofIndices(MeshoptIndices(data).sequence(count), stride)
      case other => fail(s"expected the mode ATTRIBUTES, TRIANGLES or INDICES, found `$other`")
    if filter != "NONE" then
      check(mode == "ATTRIBUTES", s"the filter `$filter` is of attributes")
      MeshoptFilters(out, stride).run(filter)
    out

  private def ofIndices(indices: Array[Int], stride: Int): ByteBuffer =
    check(stride == 2 || stride == 4, s"indices of $stride bytes")
    val out = ByteBuffer.allocate(indices.length * stride).order(ByteOrder.LITTLE_ENDIAN)
    if stride == 4 then indices.foreach(out.putInt(_))
    else indices.foreach(i => out.putShort(i.toShort))
    out.flip().order(ByteOrder.LITTLE_ENDIAN)

  def fail(message: String): Nothing = throw DamagedStream(message)
  def check(holds: Boolean, message: => String): Unit = if !holds then fail(message)

  def endsEarly: Nothing = fail("the compressed data ends early")

/** Decodes attributes: differences of elements, each byte of all elements of a block together. */
private final class MeshoptAttributes(data: Array[Byte], stride: Int):
  import MeshoptAttributes.*

  private val version = if data.isEmpty then Meshopt.endsEarly else data(0) - 0xa0.toByte
  Meshopt.check(version == 0 || version == 1, "the data has no header of attributes")

  private val channels = stride / 4
  private val tail = stride + version * channels
  private val end = data.length - Math.max(tail, if version == 0 then 32 else 24)
  if end < 1 then Meshopt.endsEarly
  private val baseline = data.length - tail
  private var at = 1

  /** Differences in a block, of each byte of elements in turn. */
  private val deltas = new Array[Byte](stride * MaxElements)

  def decoded(count: Int): ByteBuffer =
    val out = ByteBuffer.allocate(count * stride).order(ByteOrder.LITTLE_ENDIAN)
    val previous = ByteBuffer.wrap(data.slice(baseline, baseline + stride))
      .order(ByteOrder.LITTLE_ENDIAN)
    val block = Math.min(8192 / stride & ~(Group - 1), MaxElements)
    var first = 0
    while first < count do
      val n = Math.min(block, count - first)
      readDeltas(n)
      loop(channels)(c => restore(c, first, n, previous, out))
      first += n
    Meshopt.check(at == end, "the compressed data is longer than its elements")
    out

  private def readDeltas(n: Int): Unit =
    val controls = at
    if version == 1 then skip(channels)
    loop(stride): k =>
      val control = if version == 0 then -1 else data(controls + k / 4) >> 2 * (k % 4) & 3
      val into = k * MaxElements
      control match
        case 2 => java.util.Arrays.fill(deltas, into, into + n, 0.toByte)
        case 3 =>
          val from = at
          skip(n)
          System.arraycopy(data, from, deltas, into, n)
        case _ => readGroups((n + Group - 1) / Group, Lengths(control + 1), into)

  private def readGroups(groups: Int, lengths: Array[Int], into: Int): Unit =
    val headers = at
    skip((groups + 3) / 4)
    loop(groups): g =>
      val length = lengths(data(headers + g / 4) >> 2 * (g % 4) & 3)
      val to = into + g * Group
      length match
        case 0 => java.util.Arrays.fill(deltas, to, to + Group, 0.toByte)
        case 8 =>
          val from = at
          skip(Group)
          System.arraycopy(data, from, deltas, to, Group)
        case _ => readShort(length, to)

  /** Differences of few bits, or bytes if all of these bits are 1. */
  private def readShort(length: Int, to: Int): Unit =
    val from = at
    skip(Group * length / 8)
    val sentinel = (1 << length) - 1
    val perByte = 8 / length
    loop(Group): i =>
      // Single bits begin with the least significant one
      val shift = if length == 1 then i % 8 else (perByte - 1 - i % perByte) * length
      val bits = data(from + i / perByte) >> shift & sentinel
      deltas(to + i) =
        if bits != sentinel then bits.toByte
        else
          skip(1)
          data(at - 1)

  private def skip(bytes: Int): Unit =
    at += bytes
    if at > end then Meshopt.endsEarly

  /** Adds the differences of four bytes of each element. */
  private def restore(
      channel: Int,
      first: Int,
      n: Int,
      previous: ByteBuffer,
      out: ByteBuffer
  ): Unit =
    val mode = if version == 0 then 0 else data(baseline + stride + channel) & 0xff
    val from = 4 * channel
    def delta(k: Int, i: Int) = deltas((from + k) * MaxElements + i) & 0xff
    mode & 15 match
      case 0 if mode == 0 =>
        loop(n): i =>
          loop(4): k =>
            val value = previous.get(from + k) + unzigzag(delta(k, i))
            previous.put(from + k, value.toByte): Unit
          out.putInt((first + i) * stride + from, previous.getInt(from)): Unit
      case 1 if mode == 1 =>
        loop(n): i =>
          for k <- Seq(0, 2) do
            val difference = unzigzag(delta(k, i) | delta(k + 1, i) << 8)
            previous.putShort(from + k, (previous.getShort(from + k) + difference).toShort): Unit
          out.putInt((first + i) * stride + from, previous.getInt(from)): Unit
      case 2 =>
        loop(n): i =>
          val bits = delta(0, i) | delta(1, i) << 8 | delta(2, i) << 16 | delta(3, i) << 24
          val value = previous.getInt(from) ^ Integer.rotateRight(bits, mode >> 4)
          previous.putInt(from, value): Unit
          out.putInt((first + i) * stride + from, value): Unit
      case _ => Meshopt.fail(s"unknown channel mode $mode")

private object MeshoptAttributes:
  private val Group = 16
  private val MaxElements = 256

  /** Bits of a difference, by a group's header: of version 0, and of two modes of version 1. */
  private val Lengths = Array(Array(0, 2, 4, 8), Array(0, 1, 2, 4), Array(1, 2, 4, 8))

  private def unzigzag(v: Int): Int = v >>> 1 ^ -(v & 1)

/** Decodes indices. */
private final class MeshoptIndices(data: Array[Byte]):
  private var at = 1
  private var end = data.length

  private def checkHeader(header: Int, tail: Int): Unit =
    end = data.length - tail
    if end < 1 then Meshopt.endsEarly
    Meshopt.check((data(0) & 0xff) == header, "the data has no header of its mode")

  private def byte(): Int =
    if at >= end then Meshopt.endsEarly
    at += 1
    data(at - 1) & 0xff

  /** An unsigned number of seven bits a byte. */
  private def number(): Int =
    var value, shift = 0
    var next = 0x80
    while (next & 0x80) != 0 do
      Meshopt.check(shift < 35, "a number of more than 5 bytes")
      next = byte()
      value |= (next & 0x7f) << shift
      shift += 7
    value

  private def checkEnd(): Unit =
    Meshopt.check(at == end, "the compressed data is longer than its elements")

  /** Differences from either of two indices. */
  def sequence(count: Int): Array[Int] =
    checkHeader(header = 0xd1, tail = 4)
    val last = new Array[Int](2)
    val out = Array.fill(count):
      val v = number()
      last(v & 1) += v >>> 2 ^ -(v >>> 1 & 1)
      last(v & 1)
    checkEnd()
    out

  private var next, last = 0
  private val edges = new Array[Int](32)
  private val vertices = new Array[Int](16)
  private var edgeCount, vertexCount = 0

  private def push(a: Int, b: Int): Unit =
    edges(2 * (edgeCount & 15)) = a
    edges(2 * (edgeCount & 15) + 1) = b
    edgeCount += 1

  private def push(vertex: Int): Unit =
    vertices(vertexCount & 15) = vertex
    vertexCount += 1

  /** Where the edge, or the vertex, is that was pushed so many before the last. */
  private def slot(ago: Int, count: Int): Int =
    Meshopt.check(ago < count, "a triangle refers to what is not there")
    count - 1 - ago & 15

  private def recent(ago: Int): Int = vertices(slot(ago, vertexCount))

  private def following(): Int =
    next += 1
    next - 1

  private def explicitly(): Int =
    val v = number()
    last += v >>> 1 ^ -(v & 1)
    last

  /** Triangles that share edges or vertices with recent ones, a byte each if they can. */
  def triangles(count: Int): Array[Int] =
    checkHeader(header = 0xe1, tail = 16)
    val codes = at
    at += count / 3
    if at > end then Meshopt.endsEarly
    val out = new Array[Int](count)
    loop(count / 3): t =>
      val code = data(codes + t) & 0xff
      val (high, low) = (code >> 4, code & 15)
      val to = 3 * t
      if high < 15 then ofEdge(high, low, out, to)
      else if low < 14 then ofVertices(data(end + low) & 0xff, following(), false, out, to)
      else
        val pair = byte()
        if pair == 0 then next = 0
        ofVertices(pair, if low == 14 then following() else explicitly(), true, out, to)
    checkEnd()
    out

  private def ofEdge(edge: Int, code: Int, out: Array[Int], to: Int): Unit =
    val i = 2 * slot(edge, edgeCount)
    val (a, b) = (edges(i), edges(i + 1))
    val c = code match
      case 0 => following()
      case 13 | 14 =>
        last += 2 * code - 27
        last
      case 15 => explicitly()
      case ago => recent(ago)
    if code == 0 || code >= 13 then push(c)
    push(c, b)
    push(a, c)
    store(a, b, c, out, to)

  /** @param pair     codes of the second and the third vertex
    * @param isLong whether 15 is a vertex that follows
    */
  private def ofVertices(pair: Int, a: Int, isLong: Boolean, out: Array[Int], to: Int): Unit =
    def vertex(code: Int) =
      if code == 0 then following()
      else if code == 15 && isLong then explicitly()
      else recent(code - 1)
    def isNew(code: Int) = code == 0 || (code == 15 && isLong)
    val b = vertex(pair >> 4)
    val c = vertex(pair & 15)
    push(a)
    if isNew(pair >> 4) then push(b)
    if isNew(pair & 15) then push(c)
    push(b, a)
    push(c, b)
    push(a, c)
    store(a, b, c, out, to)

  private def store(a: Int, b: Int, c: Int, out: Array[Int], to: Int): Unit =
    out(to) = a
    out(to + 1) = b
    out(to + 2) = c

/** Transforms decoded elements in shift. */
private final class MeshoptFilters(out: ByteBuffer, stride: Int):
  private val count = out.capacity / stride
  private val bytes = stride / 4
  private val maxSigned = if bytes == 1 then 127 else 32767
  private val maxUnsigned = if bytes == 1 then 255 else 65535

  def run(filter: String): Unit = filter match
    case "EXPONENTIAL" =>
      loop(out.capacity / 4): i =>
        val v = out.getInt(4 * i)
        out.putFloat(4 * i, ((v << 8 >> 8) * Math.pow(2, v >> 24)).toFloat): Unit
    case "OCTAHEDRAL" => transformed(octahedral)
    case "QUATERNION" =>
      Meshopt.check(stride == 8, s"quaternions of $stride bytes")
      transformed(quaternion)
    case "COLOR" => transformed(color)
    case other =>
      Meshopt.fail(
        s"expected the filter OCTAHEDRAL, QUATERNION, EXPONENTIAL or COLOR, found `$other`"
      )

  private def transformed(transform: Int => Unit): Unit =
    Meshopt.check(stride == 4 || stride == 8, s"elements of $stride bytes under a filter")
    loop(count)(i => transform(i * stride))

  private def component(at: Int, c: Int): Int =
    if bytes == 1 then out.get(at + c) else out.getShort(at + 2 * c)

  private def store(at: Int, c: Int, value: Double): Unit =
    val rounded = Math.copySign(Math.floor(Math.abs(value) + 0.5), value).toInt
    if bytes == 1 then out.put(at + c, rounded.toByte): Unit
    else out.putShort(at + 2 * c, rounded.toShort): Unit

  private def octahedral(at: Int): Unit =
    val unit = Math.max(component(at, 2), 1).toDouble
    val (u, v) = (component(at, 0) / unit, component(at, 1) / unit)
    val z = 1 - Math.abs(u) - Math.abs(v)
    val below = Math.min(z, 0.0)
    val (x, y) = (u - Math.copySign(below, u), v - Math.copySign(below, v))
    val scale = maxSigned / Math.sqrt(x * x + y * y + z * z)
    store(at, 0, x * scale)
    store(at, 1, y * scale)
    store(at, 2, z * scale)

  private def quaternion(at: Int): Unit =
    val last = component(at, 3)
    val unit = (last | 3) * Math.sqrt(2)
    val xyz = Vector.tabulate(3)(component(at, _) / unit)
    val w = Math.sqrt(Math.max(0, 1 - xyz.map(x => x * x).sum))
    for (x, k) <- (w +: xyz).zipWithIndex do store(at, ((last & 3) + k) % 4, x * maxSigned)

  private def color(at: Int): Unit =
    val alpha = component(at, 3) & maxUnsigned
    val scale = 2 * Integer.highestOneBit(Math.max(alpha, 1)) - 1
    val (y, co, cg) = (component(at, 0) & maxUnsigned, component(at, 1), component(at, 2))
    val opacity = alpha & scale >> 1
    val rgba = Vector(y + co - cg, y + cg, y - co - cg, opacity << 1 | opacity & 1)
    for (x, c) <- rgba.zipWithIndex do store(at, c, x * maxUnsigned.toDouble / scale)
