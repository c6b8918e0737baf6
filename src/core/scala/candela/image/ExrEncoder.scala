package candela.image

import candela.base.loop
import candela.concurrency.Parallel
import candela.diagnostics.Code
import candela.color.ColorSpace

import org.lwjgl.PointerBuffer
import org.lwjgl.system.MemoryStack.stackPush
import org.lwjgl.system.libc.LibCStdlib
import org.lwjgl.system.{MemoryStack, MemoryUtil}
import org.lwjgl.util.tinyexr.*
import org.lwjgl.util.tinyexr.TinyEXR.*

import java.nio.{ByteBuffer, ByteOrder, FloatBuffer}
import java.nio.charset.StandardCharsets.UTF_8

/** Calls the native encoder. */
private[image] object ExrEncoder:

  /** Scanlines per chunk, with ZIP. */
  val Rows = 16

  /** Of which native memory has a copy at a time, for each thread. */
  private val PixelsOfStrip = 1 << 18

  /** Largest finite half. */
  private val LargestHalf = 65504f

  /** The parts of a file, in order.
    *
    * @param isHalf whether to store 16 bits per value of a channel; the encoder rounds
    * @param pool   encodes strips of chunks
    * @param window in which the image has its place, if it is a crop
    */
  def encode(
      image: Image,
      metadata: Vector[(String, String)],
      isHalf: String => Boolean,
      pool: Parallel = Parallel.Alone,
      window: Option[ImageWindow] = None,
      pixelsOfStrip: Int = PixelsOfStrip
  ): Vector[ByteBuffer] =
    Natives.require("tinyexr")
    val rows = Math.max(1, pixelsOfStrip / image.width / Rows) * Rows
    val strips = new Array[Array[Byte]]((image.height + rows - 1) / rows)
    pool.forEach(strips.length): i =>
      // Of the others' headers only their own pixels matter
      val texts = if i == 0 then metadata else Vector.empty
      strips(i) = encode(image, i * rows, Math.min(rows, image.height - i * rows), texts, isHalf)
    if strips.length == 1 && window.isEmpty then Vector(ByteBuffer.wrap(strips(0)))
    else ExrWindow.joined(strips, rows, image.height, Rows, window)

  /** A file of some rows of the image. */
  private def encode(
      image: Image,
      first: Int,
      height: Int,
      metadata: Vector[(String, String)],
      isHalf: String => Boolean
  ): Array[Byte] =
    // Readers look channels up by binary search: the file must have them sorted by name.
    val order = image.channelNames.indices.sortBy(image.channelNames)
    val halves = order.map(i => isHalf(image.channelNames(i)))
    val planes = order.zip(halves).map: (channel, half) =>
      plane(image, first, height, channel, if half then LargestHalf else Float.MaxValue)
    // Allocated individually: MemoryStack is too small for many channels.
    val channels = EXRChannelInfo.calloc(order.size)
    val types = MemoryUtil.memCallocInt(order.size)
    val stored = MemoryUtil.memCallocInt(order.size)
    val stated = metadata.map((name, text) => (name, "string", MemoryUtil.memUTF8(text, false))) ++
      chromaticities(image.colorSpace)
    val attributes = EXRAttribute.calloc(Math.max(1, stated.size))
    val stack = stackPush()
    try
      loop(order.size): i =>
        val name = image.channelNames(order(i))
        writeText(channels.get(i).name, name)
        val _ = channels.get(i).pixel_type(TINYEXR_PIXELTYPE_FLOAT).x_sampling(1).y_sampling(1)
        val _ = types.put(i, TINYEXR_PIXELTYPE_FLOAT)
        val kind = if halves(i) then TINYEXR_PIXELTYPE_HALF else TINYEXR_PIXELTYPE_FLOAT
        val _ = stored.put(i, kind)
      loop(stated.size): i =>
        val (name, typeName, value) = stated(i)
        writeText(attributes.get(i).name, name)
        writeText(attributes.get(i).`type`, typeName)
        val _ = attributes.get(i).value(value)
      val header = EXRHeader.calloc(stack)
      InitEXRHeader(header)
      header
        .num_channels(order.size)
        .channels(channels)
        .pixel_types(types)
        .requested_pixel_types(stored)
        .compression_type(TINYEXR_COMPRESSIONTYPE_ZIP)
      if stated.nonEmpty then
        val _ = header.num_custom_attributes(stated.size).custom_attributes(attributes)
      save(image.width, height, header, planes, stack)
    finally
      planes.foreach(MemoryUtil.memFree(_))
      stated.foreach(a => MemoryUtil.memFree(a(2)))
      channels.free()
      attributes.free()
      MemoryUtil.memFree(types)
      MemoryUtil.memFree(stored)
      stack.close()

  /** Omitted for sRGB, which is the default. */
  private def chromaticities(space: ColorSpace): Option[(String, String, ByteBuffer)] =
    Option.when(!space.isSrgb):
      val value = MemoryUtil.memAlloc(32).order(ByteOrder.LITTLE_ENDIAN)
      space.primaries.toFloats.zipWithIndex.foreach((v, i) => value.putFloat(4 * i, v))
      ("chromaticities", "chromaticities", value)

  private def save(
      width: Int,
      height: Int,
      header: EXRHeader,
      planes: Seq[FloatBuffer],
      stack: MemoryStack
  ): Array[Byte] =
    val pointers = MemoryUtil.memAllocPointer(planes.size)
    try
      planes.zipWithIndex.foreach((p, i) => pointers.put(i, MemoryUtil.memAddress(p)))
      val native = EXRImage.calloc(stack)
      InitEXRImage(native)
      native.images(pointers).width(width).height(height).num_channels(planes.size)
      val error = stack.callocPointer(1)
      val memory: PointerBuffer = stack.callocPointer(1)
      val size = SaveEXRImageToMemory(native, header, memory, error)
      if size <= 0 then
        throw ImageError(
          Code.UnsupportedImage,
          s"can't be encoded as EXR: ${ExrDecoder.message(0, error)}"
        )
      try
        if size > Int.MaxValue - 8 then
          throw ImageError(Code.TooLarge, "an EXR file of more than 2 GB")
        val bytes = new Array[Byte](size.toInt)
        val _ = MemoryUtil.memByteBuffer(memory.get(0), size.toInt).get(bytes)
        bytes
      finally LibCStdlib.nfree(memory.get(0))
    finally MemoryUtil.memFree(pointers)

  /** @param maxValue limit to which larger finite values are clamped */
  private def plane(
      image: Image,
      first: Int,
      height: Int,
      channel: Int,
      maxValue: Float
  ): FloatBuffer =
    val values = MemoryUtil.memAllocFloat(image.width * height)
    loop(values.capacity): i =>
      val value = image.data((image.width * first + i) * image.channels + channel)
      val isBeyond = java.lang.Float.isFinite(value) && Math.abs(value) > maxValue
      val _ = values.put(i, if isBeyond then Math.copySign(maxValue, value) else value)
    values

  /** Writes into a zeroed array of 256 bytes. */
  private def writeText(field: ByteBuffer, text: String): Unit =
    val _ = field.put(text.getBytes(UTF_8))
