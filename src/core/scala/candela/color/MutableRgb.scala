package candela.color

/** Accumulator of linear light, or of a product of weights. One per worker. */
final class MutableRgb:
  var r, g, b = 0f

  def set(c: Rgb): Unit = set(c.r, c.g, c.b)
  def set(c: MutableRgb): Unit = set(c.r, c.g, c.b)

  def set(red: Float, green: Float, blue: Float): Unit =
    r = red
    g = green
    b = blue

  def add(c: Rgb): Unit = add(c.r, c.g, c.b)
  def add(c: MutableRgb): Unit = add(c.r, c.g, c.b)

  def add(red: Float, green: Float, blue: Float): Unit =
    r += red
    g += green
    b += blue

  /** Adds a · c. */
  def addProduct(a: MutableRgb, c: MutableRgb): Unit =
    r += a.r * c.r
    g += a.g * c.g
    b += a.b * c.b

  /** Adds a · c · weight. */
  def addProduct(a: MutableRgb, c: Rgb, weight: Float): Unit =
    r += a.r * c.r * weight
    g += a.g * c.g * weight
    b += a.b * c.b * weight

  def scale(c: Rgb): Unit = scale(c.r, c.g, c.b)

  def scale(c: MutableRgb): Unit = scale(c.r, c.g, c.b)

  private def scale(red: Float, green: Float, blue: Float): Unit =
    r *= red
    g *= green
    b *= blue

  def scale(s: Float): Unit =
    r *= s
    g *= s
    b *= s

  /** Product with `s`. */
  def *(s: Float): Rgb = Rgb(r * s, g * s, b * s)

  def isBlack: Boolean = r == 0f && g == 0f && b == 0f

  /** Largest magnitude, as [[Rgb.largest]]. */
  def largest: Float = toRgb.largest

  /** A copy of the current value. */
  def toRgb: Rgb = Rgb(r, g, b)
