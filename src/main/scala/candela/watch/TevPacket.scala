package candela.watch

import java.io.ByteArrayOutputStream
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.{ByteBuffer, ByteOrder}

/** Packets of the network protocol of the image viewer tev: length in bytes, operation, and what
  * the operation needs; integers and Floats are little-endian, strings end with a zero.
  *
  * Source: Müller, "tev: The EDR viewer", README, "Over the Network"; the layouts of operations are
  * those of its client libraries.
  */
private[watch] object TevPacket:

  /** Creates an image without contents, in place of one of the same name. */
  def create(name: String, width: Int, height: Int, channels: Vector[String]): Array[Byte] =
    val packet = Writer(CreateImage)
    packet.byte(1) // shows it
    packet.text(name)
    for number <- Vector(width, height, channels.size) do packet.int(number)
    channels.foreach(packet.text)
    packet.bytes

  /** Replaces a channel in a rectangle of `width` columns; `values` row by row. */
  def update(
      name: String,
      channel: String,
      x: Int,
      y: Int,
      width: Int,
      values: Array[Float]
  ): Array[Byte] =
    val packet = Writer(UpdateImage)
    packet.byte(0) // leaves the viewer at the image that it shows
    packet.text(name)
    packet.int(1)
    packet.text(channel)
    for number <- Vector(x, y, width, values.length / width) do packet.int(number)
    packet.int64(0) // the first value of the channel
    packet.int64(1) // distance to the next
    packet.floats(values)
    packet.bytes

  // Operations; the third layout of updates
  private val CreateImage = 4
  private val UpdateImage = 6

  private final class Writer(operation: Int):
    private val packet = ByteArrayOutputStream()
    int(0) // the length
    byte(operation)

    def byte(value: Int): Unit = packet.write(value)
    def int(value: Int): Unit = append(4)(_.putInt(value))
    def int64(value: Long): Unit = append(8)(_.putLong(value))

    def text(words: String): Unit =
      packet.writeBytes(words.getBytes(UTF_8))
      byte(0)

    def floats(values: Array[Float]): Unit =
      append(4 * values.length)(_.asFloatBuffer.put(values))

    def bytes: Array[Byte] =
      val bytes = packet.toByteArray
      val _ = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).putInt(bytes.length)
      bytes

    private def append(size: Int)(put: ByteBuffer => Any): Unit =
      val bytes = new Array[Byte](size)
      val _ = put(ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN))
      packet.writeBytes(bytes)
