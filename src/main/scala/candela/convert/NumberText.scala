package candela.convert

import candela.base.RestBuffer
import java.lang.Math.abs

import candela.scenefile.Param

/** Formats numbers with the fewest digits that round-trip. */
object NumberText:

  def of(value: Float): String =
    if value == 0f then zero(1f / value < 0f)
    else if value.isInfinite then (if value > 0f then "1e39" else "-1e39") // overflows when read
    else if abs(value) < 1e7f && value == value.toInt.toFloat then value.toInt.toString
    else sign(value < 0f) + plain(shortest(abs(value).toString, _.toFloat == abs(value)))

  def of(value: Double): String =
    if value == 0.0 then zero(1.0 / value < 0.0)
    else if abs(value) < 1e15 && value == value.toLong.toDouble then value.toLong.toString
    else sign(value < 0.0) + plain(shortest(abs(value).toString, _.toDouble == abs(value)))

  /** A coordinate: where Floats are coarse, with 15 digits, because they are all read. */
  def of(p: Param, i: Int): String =
    if !RestBuffer.isCoarse(p.floats(i)) || !java.lang.Float.isFinite(p.floats(i)) then
      of(p.floats(i))
    else
      val digits = java.math.MathContext(15, java.math.RoundingMode.HALF_EVEN)
      of(java.math.BigDecimal(p.number(i)).round(digits).doubleValue)

  private def sign(isNegative: Boolean) = if isNegative then "-" else ""
  private def zero(isNegative: Boolean) = if isNegative then "-0" else "0"

  /** Before version 19 Java sometimes writes a digit too many (JDK-4511638). */
  private val writesMore = Runtime.version.feature < 19

  private def shortest(text: String, isSame: String => Boolean): java.math.BigDecimal =
    var result = java.math.BigDecimal(text).stripTrailingZeros
    var shrinks = writesMore
    while shrinks && result.precision > 1 do
      val context = java.math.MathContext(result.precision - 1, java.math.RoundingMode.HALF_EVEN)
      val shorter = result.round(context).stripTrailingZeros
      shrinks = isSame(shorter.toString)
      if shrinks then result = shorter
    result

  /** `0.25`, `1200`, but `1e-7` and `3.4e38`. */
  private def plain(value: java.math.BigDecimal): String =
    val exponent = value.precision - value.scale - 1
    if exponent >= -5 && exponent < 9 then value.toPlainString
    else
      val digits = value.unscaledValue.toString
      val mantissa = if digits.length == 1 then digits else s"${digits.head}.${digits.tail}"
      s"${mantissa}e$exponent"
