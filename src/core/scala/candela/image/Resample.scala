package candela.image

import candela.base.loop
import candela.diagnostics.Code
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
      Natives.require("stb")
      val source = image.linear
      val resized = new Array[Float](Image.valueCount(width, height, source.channels))
      val input = MemoryUtil.memAllocFloat(source.width * source.height)
      val output = MemoryUtil.memAllocFloat(width * height)
      try
        loop(source.channels): c =>
          loop(input.capacity)(i => store(input, i, source.data(i * source.channels + c)))
          val done = nstbir_resize(
            MemoryUtil.memAddress(input), source.width, source.height, 0,
            MemoryUtil.memAddress(output), width, height, 0,
            STBIR_1CHANNEL, STBIR_TYPE_FLOAT, STBIR_EDGE_CLAMP, STBIR_FILTER_TRIANGLE
          )
          if done == 0 then
            throw ImageError(Code.TooLarge, s"can't be resized to $width×$height pixels")
          loop(output.capacity)(i => resized(i * source.channels + c) = output.get(i))
      finally
        MemoryUtil.memFree(input)
        MemoryUtil.memFree(output)
      Image(width, height, source.channelNames, resized, colorSpace = source.colorSpace)

  private def store(buffer: java.nio.FloatBuffer, i: Int, value: Float): Unit =
    val _ = buffer.put(i, value)
