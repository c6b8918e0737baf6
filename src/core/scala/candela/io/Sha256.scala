package candela.io

import candela.concurrency.Parallel
import java.io.InputStream
import java.nio.ByteBuffer
import java.nio.charset.StandardCharsets.UTF_8
import java.security.MessageDigest
import java.util.HexFormat

import scala.util.Using

/** Digests of contents: SHA-256 (FIPS 180-4), in 64 hexadecimal digits. */
object Sha256:
  def of(text: String): String = hex(bytesOf(text))

  /** As `of`, in 32 bytes. */
  def bytesOf(text: String): Array[Byte] = start().digest(text.getBytes(UTF_8))

  def of(bytes: ByteBuffer): String =
    val sum = start()
    sum.update(bytes)
    hex(sum.digest)

  /** Digest of the rest of a stream, which is then closed.
    *
    * @throws java.io.IOException if it can't be read
    */
  def ofAll(stream: => InputStream): String = Using.resource(stream)(ofRest)

  /** Of a stream that stays open. */
  def ofRest(in: InputStream): String =
    val sum = start()
    val buffer = new Array[Byte](1 << 16)
    var count = in.read(buffer)
    while count >= 0 do
      sum.update(buffer, 0, count)
      count = in.read(buffer)
    hex(sum.digest)

  /** Of texts that end each with a line break. */
  def ofLines(texts: Iterator[String]): String =
    val sum = start()
    for text <- texts do sum.update(s"$text\n".getBytes(UTF_8))
    hex(sum.digest)

  /** Of bytes that come one after the other. */
  private[candela] final class Bytes extends ContentDigest:
    private val sum = start()
    def add(bytes: Array[Byte], from: Int, length: Int): Unit = sum.update(bytes, from, length)
    def result(): String = hex(sum.digest)

  /** Of many numbers: the digest of those of pieces of one size, which threads share. */
  def ofNumbers(parts: Seq[Numbers], parallel: Parallel): Array[Byte] =
    val pieces = parts.toVector.flatMap: p =>
      (p.from until p.until by Piece).map(i =>
        p.copy(from = i, until = Math.min(i + Piece, p.until))
      )
    val sums = parallel.map(pieces.size)(i => start().digest(pieces(i).bytes))
    val combined = start()
    for p <- parts do combined.update(ByteBuffer.allocate(4).putInt(p.until - p.from).flip())
    sums.foreach(combined.update)
    combined.digest()

  def hex(digest: Array[Byte]): String = HexFormat.of.formatHex(digest)

  /** Some numbers of an array of Floats, with all their bits, or of Ints. */
  final case class Numbers(array: Array[Float] | Array[Int], from: Int, until: Int):
    private[Sha256] def bytes: Array[Byte] =
      val buffer = ByteBuffer.allocate(4 * (until - from))
      array match
        case floats: Array[Float] => buffer.asFloatBuffer.put(floats, from, until - from): Unit
        case ints: Array[Int] => buffer.asIntBuffer.put(ints, from, until - from): Unit
      buffer.array

  object Numbers:
    def apply(array: Array[Float] | Array[Int]): Numbers = array match
      case floats: Array[Float] => Numbers(floats, 0, floats.length)
      case ints: Array[Int] => Numbers(ints, 0, ints.length)

  /** Numbers of a piece. */
  private val Piece = 1 << 17

  private def start() = MessageDigest.getInstance("SHA-256")
