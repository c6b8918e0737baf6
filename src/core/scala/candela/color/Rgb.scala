package candela.color

/** Linear light in the primaries of sRGB (Rec. 709): radiance, reflectance, or a weight. Immutable;
  * [[MutableRgb]] accumulates.
  */
final class Rgb(val r: Float, val g: Float, val b: Float):

  def +(c: Rgb): Rgb = Rgb(r + c.r, g + c.g, b + c.b)
  def -(c: Rgb): Rgb = Rgb(r - c.r, g - c.g, b - c.b)
  def *(c: Rgb): Rgb = Rgb(r * c.r, g * c.g, b * c.b)
  def *(s: Float): Rgb = Rgb(r * s, g * s, b * s)
  def /(c: Rgb): Rgb = Rgb(r / c.r, g / c.g, b / c.b)

  def isBlack: Boolean = r == 0f && g == 0f && b == 0f
  def isFinite: Boolean =
    java.lang.Float.isFinite(r) && java.lang.Float.isFinite(g) && java.lang.Float.isFinite(b)
  def max: Float = if r > g then (if r > b then r else b) else if g > b then g else b

  /** The larger of each component. */
  def atLeast(c: Rgb): Rgb = Rgb(Math.max(r, c.r), Math.max(g, c.g), Math.max(b, c.b))

  /** Largest magnitude: the colour of a single wavelength may be negative. */
  def largest: Float =
    val x = Math.abs(r)
    val y = Math.abs(g)
    val z = Math.abs(b)
    if x > y then (if x > z then x else z) else if y > z then y else z

  def average: Float = (r + g + b) * (1f / 3f)

  /** CIE Y of these primaries (ITU-R BT.709-6, table 3). */
  def luminance: Float = 0.2126f * r + 0.7152f * g + 0.0722f * b

  inline def map(inline f: Float => Float): Rgb = Rgb(f(r), f(g), f(b))

  override def equals(other: Any): Boolean = other match
    case c: Rgb => r == c.r && g == c.g && b == c.b
    case _ => false
  override def hashCode: Int =
    // Adding 0 makes 0 of −0, which equals it
    def bits(x: Float) = java.lang.Float.floatToIntBits(x + 0f)
    (31 * bits(r) + bits(g)) * 31 + bits(b)
  override def toString: String = s"rgb($r, $g, $b)"

object Rgb:
  val Black: Rgb = Rgb(0f, 0f, 0f)
  val White: Rgb = Rgb(1f, 1f, 1f)
  def gray(v: Float): Rgb = Rgb(v, v, v)
