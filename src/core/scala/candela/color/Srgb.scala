package candela.color

/** The sRGB transfer function and its inverse, as used by 8-bit images and displays.
  *
  * Source: IEC 61966-2-1:1999, §5.2, with the published break points 0.0031308 and 0.04045. Inputs
  * may be outside [0, 1]: the linear segment continues below 0, the power above 1.
  */
object Srgb:

  /** Linear light from the stored value. */
  def decode(encoded: Float): Float =
    if encoded <= 0.04045f then encoded * (1f / 12.92f)
    else Math.pow((encoded + 0.055) / 1.055, 2.4).toFloat

  /** The value to store from linear light. */
  def encode(linear: Float): Float =
    if linear <= 0.0031308f then linear * 12.92f
    else (1.055 * Math.pow(linear.toDouble, 1.0 / 2.4) - 0.055).toFloat

  /** The nearest 8-bit code; clamps, and maps NaN to 0. */
  def encode8(linear: Float): Int =
    if !(linear > 0f) then 0
    else if linear >= 1f then 255
    else (encode(linear) * 255f + 0.5f).toInt

/** Transfer function of an image's stored values. */
enum Encoding:
  case Linear
  case Srgb

  /** Light is the stored value to the power of `exponent`. */
  case Gamma(exponent: Float)

  def decode(stored: Float): Float = this match
    case Encoding.Linear => stored
    case Encoding.Srgb => candela.color.Srgb.decode(stored)
    case Encoding.Gamma(exponent) =>
      Math.pow(Math.max(stored, 0f).toDouble, exponent.toDouble).toFloat
