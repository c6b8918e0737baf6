package candela.image

import candela.base.loop
import candela.diagnostics.Code
import org.lwjgl.PointerBuffer
import org.lwjgl.system.MemoryStack.stackPush
import org.lwjgl.system.libc.LibCStdlib
import org.lwjgl.system.{MemoryStack, MemoryUtil}
import org.lwjgl.util.tinyexr.*
import org.lwjgl.util.tinyexr.TinyEXR.*

import java.nio.{ByteBuffer, IntBuffer}

/** Calls the native decoder, for files whose header [[ExrHeader]] has accepted. */
private[image] object ExrDecoder:

  /** Decodes parts into `target`, interleaved.
    *
    * @param sources the parts of one size that are read, with the numbers of their channels in the
    *                order of the target's
    */
  def decode(
      file: Array[Byte],
      parts: Vector[ExrPart],
      sources: Vector[(Int, Array[Int])],
      target: Array[Float]
  ): Unit =
    Natives.require("tinyexr")
    val stack = stackPush()
    val native = MemoryUtil.memAlloc(file.length)
    try
      native.put(file).flip()
      val version = EXRVersion.calloc(stack)
      check(ParseEXRVersionFromMemory(version, native), stack.callocPointer(1))
      if version.multipart then decodeMultipart(version, native, parts, sources, target, stack)
      else decodeSinglePart(version, native, parts.head, sources.head._2, target, stack)
    finally
      MemoryUtil.memFree(native)
      stack.close()

  private def decodeSinglePart(
      version: EXRVersion,
      file: ByteBuffer,
      part: ExrPart,
      order: Array[Int],
      target: Array[Float],
      stack: MemoryStack
  ): Unit =
    val error = stack.callocPointer(1)
    val header = EXRHeader.calloc(stack)
    val image = EXRImage.calloc(stack)
    InitEXRHeader(header)
    InitEXRImage(image)
    check(ParseEXRHeaderFromMemory(header, version, file, error), error)
    try
      requestFloats(header)
      check(LoadEXRImageFromMemory(image, header, file, error), error)
      try gather(image, header, part, order, target, first = 0)
      finally free(image)
    finally
      val _ = FreeEXRHeader(header)

  private def decodeMultipart(
      version: EXRVersion,
      file: ByteBuffer,
      parts: Vector[ExrPart],
      sources: Vector[(Int, Array[Int])],
      target: Array[Float],
      stack: MemoryStack
  ): Unit =
    val error = stack.callocPointer(1)
    val list = stack.callocPointer(1)
    val count = stack.callocInt(1)
    check(ParseEXRMultipartHeaderFromMemory(list, count, version, file, error), error)
    val pointers = list.getPointerBuffer(0, count.get(0))
    def header(i: Int) = EXRHeader.create(pointers.get(i))
    try
      if count.get(0) != parts.size then
        throw ImageError(Code.DamagedImage, "the header is damaged")
      loop(parts.size)(i => requestFloats(header(i)))
      val images = EXRImage.calloc(parts.size)
      try
        loop(parts.size)(i => InitEXRImage(images.get(i)))
        check(LoadEXRMultipartImageFromMemory(images, pointers, file, error), error)
        try
          val firsts = sources.scanLeft(0)(_ + _._2.length)
          for ((i, order), first) <- sources.zip(firsts) do
            gather(images.get(i), header(i), parts(i), order, target, first)
        finally loop(parts.size)(i => free(images.get(i)))
      finally images.free()
    finally
      loop(count.get(0)): i =>
        val _ = FreeEXRHeader(header(i))
        LibCStdlib.nfree(pointers.get(i))
      LibCStdlib.nfree(list.get(0))

  /** The decoder converts half to float; it does not convert integers. */
  private def requestFloats(header: EXRHeader): Unit =
    val pixelTypes: IntBuffer = header.pixel_types
    val requested: IntBuffer = header.requested_pixel_types
    loop(header.num_channels): i =>
      if pixelTypes.get(i) != TINYEXR_PIXELTYPE_UINT then
        val _ = requested.put(i, TINYEXR_PIXELTYPE_FLOAT)

  /** @param first channel of the target */
  private def gather(
      image: EXRImage,
      header: EXRHeader,
      part: ExrPart,
      order: Array[Int],
      target: Array[Float],
      first: Int
  ): Unit =
    val channels = target.length / (part.width * part.height)
    val agrees = image.width == part.width && image.height == part.height &&
      image.num_channels == order.length && header.num_channels == order.length
    if !agrees then throw ImageError(Code.DamagedImage, "the header is damaged")
    loop(order.length): to =>
      val fileChannel = order(to)
      val isInteger = part.channels(fileChannel).pixelType == TINYEXR_PIXELTYPE_UINT
      part.tiling match
        case None =>
          val plane = Plane(image.images.get(fileChannel), part.width, isInteger)
          plane.copy(target, part.width, channels, first + to, 0, 0, part.width, part.height)
        case Some(tiling) =>
          val (tw, th) = (tiling.width, tiling.height)
          val tiles = image.tiles
          loop(image.num_tiles): i =>
            val tile = tiles.get(i)
            val (x, y) = (tile.offset_x * tw, tile.offset_y * th)
            val inside = x >= 0 && y >= 0 && x + tile.width <= part.width &&
              y + tile.height <= part.height && tile.width <= tw && tile.height <= th
            if !inside then throw ImageError(Code.DamagedImage, "a tile lies outside the image")
            val plane = Plane(tile.images(order.length).get(fileChannel), tw, isInteger)
            plane.copy(target, part.width, channels, first + to, x, y, tile.width, tile.height)

  /** A channel of the image or of a tile in native memory. */
  private final class Plane(address: Long, stride: Int, isInteger: Boolean):

    def copy(
        target: Array[Float],
        targetWidth: Int,
        channels: Int,
        channel: Int,
        x0: Int,
        y0: Int,
        width: Int,
        rows: Int
    ): Unit =
      loop(rows): y =>
        loop(width): x =>
          val pixelAddress = address + 4 * (y.toLong * stride + x)
          val value =
            if isInteger then (MemoryUtil.memGetInt(pixelAddress) & 0xffffffffL).toFloat
            else MemoryUtil.memGetFloat(pixelAddress)
          target(((y0 + y) * targetWidth + x0 + x) * channels + channel) = value

  private def free(image: EXRImage): Unit =
    val _ = FreeEXRImage(image)

  private def check(code: Int, error: PointerBuffer): Unit =
    if code != TINYEXR_SUCCESS then
      throw ImageError(Code.DamagedImage, s"can't be decoded: ${message(code, error)}")

  /** Reads and frees the library's error message. */
  private[image] def message(code: Int, error: PointerBuffer): String =
    if error.get(0) == 0 then s"EXR error $code"
    else
      val text = MemoryUtil.memUTF8(error.get(0))
      nFreeEXRErrorMessage(error.get(0))
      text.trim
