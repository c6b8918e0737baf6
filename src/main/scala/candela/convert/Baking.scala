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
    * @param parts points per pixel, along each axis
    * @param color linear value at s and t in [0, 1], t upwards
    */
  def write(files: SideFiles, parts: Int = 4)(color: (Float, Float) => Rgb): String =
    val image = Image.rgb(size, size)
    loop(size): y =>
      loop(size): x =>
        var sum = Rgb.Black
        loop(parts * parts): k =>
          val i = x + (k % parts + 0.5f) / parts
          val j = y + (k / parts + 0.5f) / parts
          sum += color(i / size, 1f - j / size)
        val mean = sum * (1f / (parts * parts))
        val at = 3 * (y * size + x)
        image.data(at) = mean.r
        image.data(at + 1) = mean.g
        image.data(at + 2) = mean.b
    files.add("texture", "exr", ImageFiles.exr(image))

  def describe: String = s"an image of $size × $size pixels"

object Baking:
  /** Pixels along each side, unless the user says otherwise. */
  val DefaultSize = 1024
