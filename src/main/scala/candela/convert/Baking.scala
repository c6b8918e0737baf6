package candela.convert

import candela.base.loop
import candela.color.Rgb
import candela.image.{Image, ImageFiles}
import candela.math.Vec3
import candela.scenefile.SceneDescription

/** A texture by itself: its linear sRGB value where a surface has the parameters `u` and `v` and
  * the point `p`, in world space.
  */
trait TextureValue:
  def apply(u: Float, v: Float, p: Vec3): Rgb

/** Replaces textures that the target dialect lacks by images.
  *
  * @param size   width and height of the images, in pixels
  * @param values value of the last texture of a description; None if it can't be built
  */
final class Baking(val size: Int, val values: SceneDescription => Option[TextureValue]):

  /** Writes an image; returns its name.
    *
    * @param samplesAcross points per pixel, along each axis
    * @param color linear value at s and t in [0, 1], t upwards
    */
  def write(files: SideFiles, samplesAcross: Int = 4)(color: (Float, Float) => Rgb): String =
    val image = Image.rgb(size, size)
    loop(size): y =>
      loop(size): x =>
        var sum = Rgb.Black
        loop(samplesAcross * samplesAcross): k =>
          val i = x + (k % samplesAcross + 0.5f) / samplesAcross
          val j = y + (k / samplesAcross + 0.5f) / samplesAcross
          sum += color(i / size, 1f - j / size)
        val mean = sum * (1f / (samplesAcross * samplesAcross))
        val offset = 3 * (y * size + x)
        image.data(offset) = mean.r
        image.data(offset + 1) = mean.g
        image.data(offset + 2) = mean.b
    files.add("texture", "exr", ImageFiles.exr(image))

  def describe: String = s"an image of $size × $size pixels"

object Baking:
  /** Pixels along each side, unless the user says otherwise. */
  val DefaultSize = 1024
