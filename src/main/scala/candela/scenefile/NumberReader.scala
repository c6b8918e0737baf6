package candela.scenefile

import java.lang.Double.doubleToRawLongBits
import java.nio.charset.StandardCharsets.ISO_8859_1

/** Reads decimal numbers (`1`, `.5`, `-2.`, `+1e-3`) straight from bytes, without strings.
  *
  * Every result is correctly rounded: nearest Float, Double; `NumberReaderSuite` compares with the
  * JDK's own parser.
  */
final class NumberReader(bytes: Array[Byte]):
  private var from = 0
  private var until = 0
  private var isNegative = false
  private var mantissa = 0L
  private var exponent = 0

  /** Reads the number that begins at `at`. Returns the offset after it; −1 if there is no number,
    * or something sticks to its end. The conversions below speak of the number last read.
    */
  def scan(at: Int): Int =
    val end = bytes.length
    var i = at
    isNegative = i < end && bytes(i) == '-'
    if i < end && (isNegative || bytes(i) == '+') then i += 1
    // Digits beyond the 18th change the value by less than 1e-17 of itself: far below a Double's
    // step.
    var m = 0L
    var e = 0
    val whole = i
    while i < end && isDigit(bytes(i)) do
      if m < EighteenDigits then m = m * 10 + (bytes(i) - '0') else e += 1
      i += 1
    var digits = i - whole
    if i < end && bytes(i) == '.' then
      i += 1
      val fraction = i
      while i < end && isDigit(bytes(i)) do
        if m < EighteenDigits then
          m = m * 10 + (bytes(i) - '0')
          e -= 1
        i += 1
      digits += i - fraction
    from = at
    mantissa = m
    exponent = e
    if digits == 0 then -1
    else
      if i < end && (bytes(i) == 'e' || bytes(i) == 'E') then i = scanExponent(i + 1)
      until = i
      if i < 0 || i == end || NumberReader.isDelimiter(bytes(i)) then i else -1

  private def scanExponent(at: Int): Int =
    var i = at
    val negative = i < bytes.length && bytes(i) == '-'
    if i < bytes.length && (negative || bytes(i) == '+') then i += 1
    val first = i
    var value = 0
    while i < bytes.length && isDigit(bytes(i)) do
      if value < 10000 then value = value * 10 + (bytes(i) - '0')
      i += 1
    exponent += (if negative then -value else value)
    if i == first then -1 else i

  def toFloat: Float =
    if exponent < -LargestPower || exponent > LargestPower then slowFloat
    else
      // Three roundings: at most 2 units in the last place of a Double, far finer than a Float's
      // step, so rounding once more is right unless the Double lies that close to halfway between
      // two Floats.
      val d = mantissa.toDouble * PowersOfTen(exponent + LargestPower)
      val fromHalfway = (doubleToRawLongBits(d) & 0x1fffffffL) - 0x10000000L
      val isNormal = d < 3e38 && (d > 1.2e-38 || mantissa == 0)
      val isSafe = isNormal && (fromHalfway > 8 || fromHalfway < -8)
      if !isSafe then slowFloat else if isNegative then -d.toFloat else d.toFloat

  def toDouble: Double =
    // exact: both factors are Doubles, so there is one rounding
    if mantissa <= (1L << 53) && exponent <= 22 && exponent >= -22 then
      val m = mantissa.toDouble
      val power = PowersOfTen((if exponent < 0 then -exponent else exponent) + LargestPower)
      val d = if exponent < 0 then m / power else m * power
      if isNegative then -d else d
    else digits.toDouble

  /** Is the number whole, as `3`, `3.0` and `3e2` are? */
  def isWhole: Boolean =
    exponent >= 0 || { val d = toDouble; d == Math.rint(d) }

  /** Does the number, without its fraction, fit an Int? */
  def fitsInt: Boolean =
    if exponent == 0 then mantissa <= Int.MaxValue || (isNegative && mantissa == 1L << 31)
    else
      val d = toDouble; d > -2147483649.0 && d < 2147483648.0

  /** The number without its fraction; meaningful if [[fitsInt]]. */
  def toInt: Int =
    if exponent != 0 then toDouble.toInt
    else if isNegative then -mantissa.toInt
    else mantissa.toInt

  private def slowFloat: Float = digits.toFloat
  private def digits: String = new String(bytes, from, until - from, ISO_8859_1)

  private inline def isDigit(c: Byte): Boolean = c >= '0' && c <= '9'
  private inline val EighteenDigits = 100000000000000000L
  private inline val LargestPower = 60
  private val PowersOfTen = NumberReader.PowersOfTen

object NumberReader:
  /** 10 to the power −60 … 60. */
  private val PowersOfTen: Array[Double] = Array.tabulate(121)(i => s"1e${i - 60}".toDouble)

  /** Can a number or a word end before this byte? */
  inline def isDelimiter(c: Byte): Boolean =
    c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == ']' || c == '[' || c == '"' || c == '#'
