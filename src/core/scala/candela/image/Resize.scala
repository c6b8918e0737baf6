package candela.image

import candela.color.Encoding

import org.lwjgl.stb.STBImageResize.{STBIR_RGB, nstbir_resize_float_linear}
import org.lwjgl.system.MemoryUtil

/** Resizes pictures: values are clamped to [0, 1], NaN black. */
object Resize:

  /** Linear R, G and B of the image, reduced to at most this size. */
  def fitting(image: Image, width: Int, height: Int): Image =
    val scale = Math.min(width.toDouble / image.width, height.toDouble / image.height)
    if scale >= 1 then finite(image)
    else
      def size(n: Int) = Math.max(1, Math.round(n * scale).toInt)
      exactly(image, size(image.width), size(image.height))

  /** Linear R, G and B of the image at this size. */
  def exactly(image: Image, width: Int, height: Int): Image =
    val input = MemoryUtil.memAllocFloat(3 * image.width * image.height)
    val output = MemoryUtil.memAllocFloat(3 * width * height)
    try
      input.put(finite(image).data).flip()
      // LWJGL's checked call demands four times the memory.
      val (source, target) = (MemoryUtil.memAddress(input), MemoryUtil.memAddress(output))
      val _ = nstbir_resize_float_linear(
        source, image.width, image.height, 0, target, width, height, 0, STBIR_RGB
      )
      val small = Image.rgb(width, height)
      val _ = output.get(small.data)
      small
    finally
      MemoryUtil.memFree(input)
      MemoryUtil.memFree(output)

  /** A value that is not finite would spread. */
  private def finite(image: Image): Image =
    val rgb = image.toRgb
    val clamped = rgb.data.map(v => if v > 0f then Math.min(v, 1f) else 0f)
    Image(rgb.width, rgb.height, Image.RgbNames, clamped, Encoding.Linear)
