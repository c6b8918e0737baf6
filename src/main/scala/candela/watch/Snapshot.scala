package candela.watch

import candela.image.Image

import java.nio.{ByteBuffer, ByteOrder}
import java.util.concurrent.ConcurrentHashMap

/** A state of the image, for viewers in any thread.
  *
  * @param version larger than that of earlier states
  * @param image   all channels: colours, AOVs, wavelength bands
  * @param noise   expected noise of the colours: a standard deviation for each pixel and channel
  */
final class Snapshot(val version: Int, val image: Image, val noise: Option[Image]):
  import Snapshot.*

  /** Names of the images within: `color`, one for each AOV, and `noise`. */
  val layers: Vector[String] =
    image.channelNames.map(layerOf).distinct ++ noise.map(_ => Noise)

  private val encoded = ConcurrentHashMap[String, LayerBytes]()

  /** A layer's numbers, if there is one of that name. Encoded once for all viewers. */
  def bytes(layer: String): Option[LayerBytes] =
    Option.when(layers.contains(layer)):
      encoded.computeIfAbsent(
        layer,
        name =>
          val (from, channels) = sourceOf(name)
          val matrix = Option.when(name == Color && !from.colorSpace.isSrgb):
            from.colorSpace.toSrgb.toFloats.toVector
          LayerBytes(channels.size, pack(from, channels), matrix)
      )

  /** Every layer's channels at a pixel of the image. */
  def pixel(x: Int, y: Int): Vector[(String, Vector[(String, Float)])] =
    val values = layers.map: layer =>
      val (from, channels) = sourceOf(layer)
      layer -> channels.map(c => from.channelNames(c) -> from(x, y, c))
    // In a standard deviation's units two images compare; variances add up.
    values ++ values.collect:
      case (Noise, noise) => "variance" -> noise.map((name, value) => name -> value * value)

  private def sourceOf(layer: String): (Image, Vector[Int]) =
    noise.filter(_ => layer == Noise) match
      case Some(n) => (n, n.channelNames.indices.toVector)
      case None =>
        (
          image,
          image.channelNames.indices.filter(c => layerOf(image.channelNames(c)) == layer).toVector
        )

object Snapshot:
  private val Color: String = "color"
  private val Noise: String = "noise"

  /** `R`, `G` and `B` are the colour, `N.X` belongs to `N`; other channels are by themselves. */
  private def layerOf(channel: String): String =
    channel match
      case "R" | "G" | "B" => Color
      case s"$layer.$part" if part.length == 1 && !layer.contains('.') => layer
      case single => single

  private def pack(image: Image, channels: Vector[Int]): Array[Byte] =
    val pixels = image.width * image.height
    val bytes =
      ByteBuffer.allocate(Math.multiplyExact(4, Math.multiplyExact(pixels, channels.size)))
    val floats = bytes.order(ByteOrder.LITTLE_ENDIAN).asFloatBuffer
    if channels.size == image.channels then floats.put(image.data)
    else
      for pixel <- 0 until pixels; c <- channels do
        floats.put(image.data(pixel * image.channels + c))
    bytes.array

/** A layer's values as little-endian Floats, channels interleaved.
  *
  * @param toSrgb matrix to linear sRGB, row by row, if the values are of another colour space
  */
final case class LayerBytes(channels: Int, data: Array[Byte], toSrgb: Option[Vector[Float]])
