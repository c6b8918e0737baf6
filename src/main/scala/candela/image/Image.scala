package candela.image

/** Pixels in memory: `channels` Floats for each, interleaved, rows from the top; linear unless said. */
final class Image(
    val width: Int,
    val height: Int,
    val channelNames: Vector[String],
    val data: Array[Float]
):
  val channels: Int = channelNames.size
  require(data.length == width.toLong * height * channels, s"$width×$height×$channels")

  def apply(x: Int, y: Int, channel: Int): Float = data((y * width + x) * channels + channel)

object Image:
  val RgbNames: Vector[String] = Vector("R", "G", "B")
  def rgb(width: Int, height: Int): Image =
    Image(width, height, RgbNames, new Array[Float](width * height * 3))
