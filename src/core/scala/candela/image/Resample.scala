package candela.image

import candela.base.{Code, loop}

import org.lwjgl.stb.STBImageResize.*
import org.lwjgl.system.MemoryUtil

/** Resizes light: any range, all channels, linear values.
  *
  * The filter is a triangle as wide as the larger of both pixels. It has no negative parts, which
  * would darken the surroundings of the sun.
  */
object Resample:

  def apply(image: Image, width: Int, height: Int): Image =
    if width == image.width && height == image.height then image
    else
      Natives.need("stb")
      val source = image.linear
      val made = new Array[Float](Image.valueCount(width, height, source.channels))
      val from = MemoryUtil.memAllocFloat(source.width * source.height)
      val to = MemoryUtil.memAllocFloat(width * height)
      try
        loop(source.channels): c =>
          loop(from.capacity)(i => put(from, i, source.data(i * source.channels + c)))
          val done = nstbir_resize(
            MemoryUtil.memAddress(from), source.width, source.height, 0,
            MemoryUtil.memAddress(to), width, height, 0,
            STBIR_1CHANNEL, STBIR_TYPE_FLOAT, STBIR_EDGE_CLAMP, STBIR_FILTER_TRIANGLE
          )
          if done == 0 then
            throw ImageError(Code.TooLarge, s"can't be resized to $width×$height pixels")
          loop(to.capacity)(i => made(i * source.channels + c) = to.get(i))
      finally
        MemoryUtil.memFree(from)
        MemoryUtil.memFree(to)
      Image(width, height, source.channelNames, made, colorSpace = source.colorSpace)

  private def put(buffer: java.nio.FloatBuffer, i: Int, value: Float): Unit =
    val _ = buffer.put(i, value)
