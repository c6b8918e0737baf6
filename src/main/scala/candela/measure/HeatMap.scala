package candela.measure

import candela.base.loop
import candela.color.Encoding
import candela.image.Image

/** Numbers as colours, from black over purple and orange to pale yellow: the map "magma" of
  * Stéfan van der Walt and Nathaniel Smith (2015, public domain), whose lightness is even, at
  * eleven places with straight lines between.
  */
object HeatMap:

  /** sRGB codes, from 0 to 1 in tenths. */
  val Colors: Vector[Int] = Vector(
    0x000004, 0x140e36, 0x3b0f70, 0x641a80, 0x8c2981, 0xb73779, 0xde4968, 0xf7705c, 0xfe9f6d,
    0xfecf92, 0xfcfdbf
  )

  /** A picture of one channel as colours; `brightest` and above is the last one. */
  def of(map: Image, brightest: Double): Image =
    val data = new Array[Float](3 * map.data.length)
    loop(map.data.length): i =>
      val value = if brightest > 0 then map.data(i) / brightest else 0.0
      val place = Math.min(1.0, Math.max(0.0, value)) * (Colors.size - 1)
      val before = Math.min(place.toInt, Colors.size - 2)
      loop(3): c =>
        val low = channel(Colors(before), c)
        val high = channel(Colors(before + 1), c)
        data(3 * i + c) = (low + (high - low) * (place - before)).toFloat
    Image(map.width, map.height, Image.RgbNames, data, Encoding.Srgb)

  /** What a map is drawn up to if nobody says: all of FLIP's range; of others the value that all
    * but the worst hundredth of the pixels stay below.
    */
  def usualBrightest(metric: Metric, map: Image): Double =
    if metric == Metric.Flip then 1.0
    else
      val sorted = map.data.sorted
      val most = sorted(Math.min(sorted.length - 1, sorted.length * 99 / 100))
      if most > 0 then most.toDouble else sorted.last.toDouble

  private def channel(color: Int, c: Int): Float = (color >> (16 - 8 * c) & 0xff) / 255f
