package candela.color

/** False colours from black through purple and orange to pale yellow: the perceptually uniform
  * colour map "magma" of Stéfan van der Walt and Nathaniel Smith (2015, public domain),
  * interpolated linearly between eleven points.
  */
object Magma:

  /** sRGB codes, from 0 to 1 in tenths. */
  val Colors: Vector[Int] = Vector(
    0x000004, 0x140e36, 0x3b0f70, 0x641a80, 0x8c2981, 0xb73779, 0xde4968, 0xf7705c, 0xfe9f6d,
    0xfecf92, 0xfcfdbf
  )

  /** Channel `c` of the colour of `value`, sRGB-encoded; values outside [0, 1] are clamped. */
  def apply(value: Double, c: Int): Float =
    val position = Math.min(1.0, Math.max(0.0, value)) * (Colors.size - 1)
    val index = Math.min(position.toInt, Colors.size - 2)
    val low = channel(Colors(index), c)
    val high = channel(Colors(index + 1), c)
    (low + (high - low) * (position - index)).toFloat

  private def channel(color: Int, c: Int): Float = (color >> (16 - 8 * c) & 0xff) / 255f
