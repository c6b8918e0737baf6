package candela.image

import candela.base.loop
import candela.diagnostics.Code
import java.io.ByteArrayOutputStream
import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_8}
import java.nio.{ByteBuffer, ByteOrder}
import java.time.LocalDateTime
import java.util.Locale
import java.util.zip.{CRC32, ZipEntry, ZipOutputStream}

/** NumPy's archives of arrays: what `numpy.load` reads. Each group of channels is an array of
  * 32-bit floats, rows from the top: `rgb` of height × width × 3, `alpha` of height × width, and
  * the other layers by their names, `Albedo` for `Albedo.R`, `Albedo.G` and `Albedo.B`. The file
  * `metadata.json` has the texts and the names of all channels.
  *
  * Source: NumPy reference, "numpy.lib.format", version 1.0.
  */
private[image] object Npz extends OutputFormat("npz", Contents.Channels):

  override def keepsTexts: Boolean = true
  override def isReadable: Boolean = false

  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val linear = image.linear
    val arrays = groups(linear.channelNames)
    val size = 4L * linear.data.length + 1024L * (arrays.size + 1)
    if size > Int.MaxValue - 8 then
      throw ImageError(Code.TooLarge, "a NumPy file of more than 2 GB")
    val bytes = ByteArrayOutputStream(size.toInt)
    val zip = ZipOutputStream(bytes, UTF_8)
    zip.setMethod(ZipOutputStream.STORED)
    for (name, channels) <- arrays do add(zip, s"$name.npy", array(linear, channels))
    add(zip, "metadata.json", about(linear, arrays, metadata, options).getBytes(UTF_8))
    zip.close()
    bytes.toByteArray

  override private[image] def hasEnd(file: Array[Byte]): Boolean =
    file.length > 22 && ByteBuffer.wrap(file, file.length - 22, 22).getInt == 0x504b0506

  /** Names of arrays, with the indices of their channels; EXR files have these by the alphabet. */
  private def groups(names: Vector[String]): Vector[(String, Vector[Int])] =
    def group(name: String) =
      if Image.RgbNames.contains(name) then "rgb"
      else if name == "A" then "alpha"
      else
        name.lastIndexOf('.') match
          case -1 => name
          case dot => name.take(dot)
    val groupNames = names.map(group)
    val order = Image.RgbNames :+ "A"
    groupNames.distinct.map: g =>
      val indices = names.indices.filter(groupNames(_) == g).toVector
      g -> indices.sortBy(i => order.indexOf(names(i).drop(names(i).lastIndexOf('.') + 1)))

  private def array(image: Image, channels: Vector[Int]): Array[Byte] =
    val depth = if channels.size == 1 then "" else s", ${channels.size}"
    val shape = s"(${image.height}, ${image.width}$depth)"
    val header = s"{'descr': '<f4', 'fortran_order': False, 'shape': $shape, }"
    val length = (header.length + Prefix + 1 + 63) / 64 * 64
    val bytes = ByteBuffer.allocate(length + 4 * image.width * image.height * channels.size)
      .order(ByteOrder.LITTLE_ENDIAN)
    val _ = bytes.put(0x93.toByte).put("NUMPY".getBytes(ISO_8859_1)).put(1: Byte).put(0: Byte)
      .putShort((length - Prefix).toShort)
      .put(header.padTo(length - Prefix - 1, ' ').getBytes(ISO_8859_1)).put('\n': Byte)
    val channelIndices = channels.toArray
    loop(image.width * image.height): pixel =>
      loop(channelIndices.length): c =>
        val _ = bytes.putFloat(image.data(pixel * image.channels + channelIndices(c)))
    bytes.array

  /** Bytes before the header of an array. */
  private val Prefix = 10

  private def add(zip: ZipOutputStream, name: String, bytes: Array[Byte]): Unit =
    val sum = CRC32()
    sum.update(bytes)
    val entry = ZipEntry(name)
    entry.setTimeLocal(FixedTime)
    entry.setSize(bytes.length)
    entry.setCrc(sum.getValue)
    zip.putNextEntry(entry)
    zip.write(bytes)
    zip.closeEntry()

  private val FixedTime = LocalDateTime.of(1980, 1, 1, 0, 0)

  private def about(
      image: Image,
      arrays: Vector[(String, Vector[Int])],
      metadata: Vector[(String, String)],
      options: WriteOptions
  ): String =
    val channels = arrays.map: (name, at) =>
      s"    ${quoted(name)}: ${at.map(c => quoted(image.channelNames(c))).mkString("[", ", ", "]")}"
    val window = options.window.toVector.map: w =>
      s"""  "window": [${w.x}, ${w.y}, ${w.width}, ${w.height}]"""
    val texts = metadata.map((name, text) => s"    ${quoted(name)}: ${quoted(text)}")
    def named(name: String, lines: Vector[String]) =
      if lines.isEmpty then s"""  "$name": {}"""
      else lines.mkString(s"  \"$name\": {\n", ",\n", "\n  }")
    (Vector(named("channels", channels)) ++ window :+ named("texts", texts))
      .mkString("{\n", ",\n", "\n}\n")

  /** As JSON writes a text. */
  private def quoted(text: String): String =
    text.flatMap:
      case c @ ('"' | '\\') => s"\\$c"
      case c if c < ' ' => "\\u%04x".formatLocal(Locale.ROOT, c.toInt)
      case c => c.toString
    .mkString("\"", "", "\"")
