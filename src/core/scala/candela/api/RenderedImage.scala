package candela.api

import candela.diagnostics.Code
import candela.image.{EncodedImage, Image}
import candela.job.ImageFile
import candela.render.Rendering

import java.nio.file.{Files, Path}
import java.util.List as JList

import scala.jdk.CollectionConverters.*

/** An image: channels of Floats, in rows from the top. The first three are `R`, `G` and `B`, linear
  * light in the film's colour space (default: sRGB); channels of layers follow. Immutable.
  */
final class RenderedImage private[api] (
    image: Image,
    hasSamples: Boolean,
    encode: Path => EncodedImage
):
  def width: Int = image.width
  def height: Int = image.height

  /** Names of the channels, in the order of the values of a pixel. */
  def channels: JList[String] = java.util.List.copyOf(image.channelNames.asJava)

  /** A value.
    *
    * @param x       column, from 0 at the left
    * @param y       row, from 0 at the top
    * @param channel index in [[channels]]
    */
  def value(x: Int, y: Int, channel: Int): Float =
    def check(index: Int, size: Int): Unit = java.util.Objects.checkIndex(index, size): Unit
    check(x, width)
    check(y, height)
    check(channel, image.channels)
    image(x, y, channel)

  /** A copy of all values, pixel by pixel. */
  def values: Array[Float] = image.data.clone()

  /** A copy of a channel's values.
    *
    * @throws SceneException if there is no such channel
    */
  def channel(name: String): Array[Float] =
    val channelIndex = index(name)
    Array.tabulate(width * height)(pixel => image.data(pixel * image.channels + channelIndex))

  /** Mean of a channel's values.
    *
    * @throws SceneException if there is no such channel
    */
  def mean(name: String): Double =
    val channelIndex = index(name)
    val count = width * height
    var sum = 0.0
    var pixel = 0
    while pixel < count do
      sum += image.data(pixel * image.channels + channelIndex)
      pixel += 1
    sum / count

  private def index(name: String): Int =
    val channelIndex = image.channelNames.indexOf(name)
    if channelIndex < 0 then
      val available = image.channelNames.mkString(", ")
      Problems.fail(Code.ImageEdit, s"the image has no channel `$name`", Some(s"it has $available"))
    channelIndex

  /** Writes a file in the format of its name: `.exr` with all channels, `.pfm` with the colours,
    * `.png`, `.jpg`, `.qoi` or `.tga` as shown on a screen. If it fails, an existing file stays; so
    * it does if the image has less than one sample per pixel.
    *
    * @throws SceneException if it can't be written
    */
  def save(file: Path): Unit = Problems.thrown:
    val help = "save a file, and copy it there; or write what `bytes` returns"
    val target = Problems.onDisk(file, Code.Unwritable, help)
    if !hasSamples && Files.isRegularFile(target) then
      val message = s"`$file` stays: the new image has less than 1 sample per pixel"
      Problems.fail(Code.Unwritable, message, Some("save it by another name"))
    encode(target).save()

  /** The bytes that [[save]] writes in a format: `exr`, `png` or another suffix of a file.
    *
    * @throws SceneException if there is no such format
    */
  def bytes(format: String): Array[Byte] =
    Problems.thrown(encode(Path.of(s"image.$format")).bytes)

  /** As `RenderedImage(640x360, R, G, B)`. */
  override def toString: String =
    Shown("RenderedImage", s"${width}x$height" +: image.channelNames*)

private[api] object RenderedImages:
  /** The image of a rendering, whose files have its metadata. */
  def of(
      image: Image,
      files: ImageFile,
      rendering: Rendering,
      denoiser: Option[String]
  ): RenderedImage =
    val hasSamples = rendering.samplesDone > 0
    RenderedImage(image, hasSamples, files.encoded(_, image, rendering, denoiser = denoiser))

  /** Any other image. */
  def plain(image: Image): RenderedImage =
    RenderedImage(image, hasSamples = true, ImageFile.encoded(_, image))
