package candela.color

/** Linear light in the primaries of sRGB (Rec. 709): radiance, reflectance, or a weight. Like
  * [[candela.math.Vec3]] a value, but for those that a worker owns to add up what a path brings.
  */
final class Rgb(red: Float, green: Float, blue: Float):
  private var ownR = red
  private var ownG = green
  private var ownB = blue

  def r: Float = ownR
  def g: Float = ownG
  def b: Float = ownB

  def copy: Rgb = Rgb(r, g, b)

  /** Takes the values of `c`; for the owner alone. */
  private[candela] def become(c: Rgb): Unit =
    ownR = c.ownR
    ownG = c.ownG
    ownB = c.ownB

  /** Takes a · b · s; for the owner alone, as what follows. */
  private[candela] def becomeProduct(a: Rgb, b: Rgb, s: Float): Unit =
    ownR = a.ownR * b.ownR * s
    ownG = a.ownG * b.ownG * s
    ownB = a.ownB * b.ownB * s

  /** Adds a · b. */
  private[candela] def addProduct(a: Rgb, b: Rgb): Unit =
    ownR += a.ownR * b.ownR
    ownG += a.ownG * b.ownG
    ownB += a.ownB * b.ownB

  private[candela] def scaleBy(c: Rgb): Unit =
    ownR *= c.ownR
    ownG *= c.ownG
    ownB *= c.ownB

  private[candela] def scaleBy(s: Float): Unit =
    ownR *= s
    ownG *= s
    ownB *= s

  def +(c: Rgb): Rgb = Rgb(r + c.r, g + c.g, b + c.b)
  def -(c: Rgb): Rgb = Rgb(r - c.r, g - c.g, b - c.b)
  def *(c: Rgb): Rgb = Rgb(r * c.r, g * c.g, b * c.b)
  def *(s: Float): Rgb = Rgb(r * s, g * s, b * s)
  def /(c: Rgb): Rgb = Rgb(r / c.r, g / c.g, b / c.b)

  def isBlack: Boolean = r == 0f && g == 0f && b == 0f
  def isFinite: Boolean =
    java.lang.Float.isFinite(r) && java.lang.Float.isFinite(g) && java.lang.Float.isFinite(b)
  def max: Float = if r > g then (if r > b then r else b) else if g > b then g else b

  /** The largest magnitude: the colour of a single wavelength may be negative. */
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
  override def hashCode: Int = (r, g, b).hashCode
  override def toString: String = s"rgb($r, $g, $b)"

object Rgb:
  val Black: Rgb = Rgb(0f, 0f, 0f)
  val White: Rgb = Rgb(1f, 1f, 1f)
  def gray(v: Float): Rgb = Rgb(v, v, v)
