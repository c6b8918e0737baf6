package candela.color

/** How the numbers of a picture stand for linear light. */
enum Encoding:
  case Linear
  case Srgb

  /** Light is the stored value to the power of `exponent`. */
  case Gamma(exponent: Float)

  def decode(stored: Float): Float = this match
    case Linear => stored
    case Srgb => candela.color.Srgb.decode(stored)
    case Gamma(exponent) => Math.pow(Math.max(stored, 0f).toDouble, exponent.toDouble).toFloat
