package candela.aov

import candela.color.Rgb
import candela.film.ExactSums
import candela.image.Image

import java.lang.Float.{floatToRawIntBits, intBitsToFloat}
import java.nio.charset.StandardCharsets.UTF_8
import java.util.Locale
import scala.util.hashing.MurmurHash3

/** Identifiers with their coverage of each pixel, ranked by coverage, and a legend in the metadata.
  * Compositors make mattes of them, with soft edges.
  *
  * Source: Friedman and Jones, "Fully Automatic ID Mattes with Support for Motion Blur and
  * Transparency", SIGGRAPH 2015 posters; and the Cryptomatte specification, version 1.2.0.
  */
object Cryptomatte:
  /** Identifiers of a pixel that are stored. */
  private val Ranks = 6

  /** Identifiers of a pixel that are counted; more are ignored. */
  private val Slots = 8

  /** The identifier of a name: its hash, as a float that is neither denormal nor NaN. */
  def id(name: String): Float =
    val hash = MurmurHash3.bytesHash(name.getBytes(UTF_8), 0)
    val exponent = Math.min(Math.max(hash >>> 23 & 255, 1), 254)
    intBitsToFloat((hash & 0x807fffff) | exponent << 23)

  /** Channels of the layer `name`, two ranks in each group. */
  def channels(name: String): Vector[String] =
    (0 until Ranks / 2).toVector.flatMap(i => Vector("R", "G", "B", "A").map(c => s"${name}0$i.$c"))

  /** Names of the layer's identifiers that occur in the image, and how they were found. */
  def metadata(name: String, legend: Seq[String], image: Image): Vector[(String, String)] =
    val ids = channels(name).filter(c => c.endsWith("R") || c.endsWith("B"))
    val pixelIds = ids.map(image.channelNames.indexOf).flatMap: channel =>
      (0 until image.width * image.height).iterator.map(i =>
        image.data(i * image.channels + channel)
      )
    val usedBits = pixelIds.map(floatToRawIntBits).toSet
    val entries =
      legend.distinct.map(n => n -> floatToRawIntBits(id(n))).filter(e => usedBits(e._2))
    val manifest =
      entries.map((n, bits) =>
        "\"" + escaped(n) + "\":\"" + "%08x".formatLocal(Locale.ROOT, bits) + "\""
      )
    val key = "cryptomatte/" + "%08x".formatLocal(Locale.ROOT, floatToRawIntBits(id(name))).take(7)
    Vector(
      s"$key/name" -> name,
      s"$key/hash" -> "MurmurHash3_32",
      s"$key/conversion" -> "uint32_to_float32",
      s"$key/manifest" -> manifest.mkString("{", ",", "}")
    )

  private def escaped(text: String): String = text.flatMap:
    case '"' => "\\\""
    case '\\' => "\\\\"
    case c if c < ' ' => "\\u%04x".formatLocal(Locale.ROOT, c.toInt)
    case c => c.toString

  /** Pairs of identifier and filter weight, in the order of their first samples. */
  private[aov] def tally(of: VisibleSurface => Float): Tally = new Tally(2 * Slots):
    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      count(sums, at, of(seen).toDouble, weight)

    private def count(sums: ExactSums, at: Int, id: Double, weight: Double): Unit =
      var i = at
      val end = at + 2 * Slots
      while i < end && sums(i) != id && sums(i) != 0.0 do i += 2
      if i < end then
        if sums(i) == 0.0 then sums.add(i, id)
        sums.add(i + 1, weight)

    override def joins: Boolean = true

    override def join(sums: ExactSums, at: Int, more: ExactSums): Unit =
      for i <- at until at + 2 * Slots by 2 do
        val (id, weight, rest) = (more(i), more(i + 1), more.remainder(i + 1))
        more.add(i, -id)
        more.add(i + 1, -weight)
        more.add(i + 1, -rest)
        if id != 0.0 then
          count(sums, at, id, weight)
          count(sums, at, id, rest)

  /** Identifiers by falling coverage, each with its coverage. */
  private[aov] final class Ranked(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] =
      val entries =
        Vector.tabulate(Slots)(i => (pixel(2 * i), pixel(2 * i + 1))).filter(_._1 != 0.0)
      val ranked = entries.sortBy((id, weight) => (-weight, id)).take(Ranks)
      val values = ranked.flatMap((id, weight) => Vector(id, weight / pixel.weight))
      values.padTo(2 * Ranks, 0.0).toArray
