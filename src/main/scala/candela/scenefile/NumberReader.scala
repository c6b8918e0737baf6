package candela.scenefile

import java.lang.Double.doubleToRawLongBits
import java.lang.Float.{floatToRawIntBits, intBitsToFloat}
import java.lang.Long.numberOfTrailingZeros
import java.lang.invoke.{MethodHandles, VarHandle}
import java.nio.ByteOrder
import java.nio.charset.StandardCharsets.ISO_8859_1

/** Reads decimal numbers (`1`, `.5`, `-2.`, `+1e-3`) straight from bytes, without strings.
  *
  * Every result is correctly rounded: nearest Float, Double; `NumberReaderSuite` compares with the
  * JDK's own parser.
  */
final class NumberReader(source: Source):
  private var from = 0
  private var until = 0
  private var sign = 0
  private var mantissa = 0L
  private var exponent = 0

  /** Where the last scan stopped: there is the first byte that is no part of a number. */
  def stop: Int = until

  /** Reads the number that begins at `at`. Returns the place after it; −1 if there is no number, or
    * something sticks to its end. The conversions below speak of the number last read.
    */
  def scan(at: Int): Int =
    val bytes = source.bytes
    if source.limit - at < NumberReader.Ahead then scanSlowly(at)
    else
      val first = bytes(at)
      sign = if first == '-' then 1 else 0
      val whole = at + sign
      val word = NumberReader.eight(bytes, whole)
      val n = NumberReader.digits(word)
      val point = whole + n
      val stop = bytes(point)
      from = at
      if n > 0 && NumberReader.isDelimiter(stop) && n < 8 then
        mantissa = NumberReader.value(word, n)
        exponent = 0
        until = point
        point
      else if n > 0 && n < 8 && stop == '.' then
        mantissa = NumberReader.value(word, n)
        exponent = 0
        val end = fraction(bytes, point + 1)
        until = end
        if end > point + 1 && NumberReader.isDelimiter(bytes(end)) then end else scanSlowly(at)
      else scanSlowly(at)

  /** Adds up to 11 digits that begin at `at`; returns the place after them. */
  private def fraction(bytes: Array[Byte], at: Int): Int =
    val word = NumberReader.eight(bytes, at)
    val n = NumberReader.digits(word)
    if n > 0 then append(word, n)
    if n < 8 then at + n
    else
      val rest = NumberReader.eight(bytes, at + 8)
      val more = NumberReader.digits(rest).min(3)
      if more > 0 then append(rest, more)
      at + 8 + more

  private inline def append(word: Long, count: Int): Unit =
    mantissa = mantissa * NumberReader.Tens(count) + NumberReader.value(word, count)
    exponent -= count

  /** The same byte by byte, for what is rare: signs other than `-`, exponents, many digits. */
  private def scanSlowly(at: Int): Int =
    val bytes = source.bytes
    val end = source.limit
    var i = at
    sign = if i < end && bytes(i) == '-' then 1 else 0
    if i < end && (sign == 1 || bytes(i) == '+') then i += 1
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
    until = i
    if digits == 0 then -1
    else
      if i < end && (bytes(i) == 'e' || bytes(i) == 'E') then i = scanExponent(i + 1)
      if i < 0 || i == end || NumberReader.isDelimiter(bytes(i)) then i else -1

  private def scanExponent(at: Int): Int =
    val bytes = source.bytes
    val end = source.limit
    var i = at
    val negative = i < end && bytes(i) == '-'
    if i < end && (negative || bytes(i) == '+') then i += 1
    val first = i
    var value = 0
    while i < end && isDigit(bytes(i)) do
      if value < 10000 then value = value * 10 + (bytes(i) - '0')
      i += 1
    exponent += (if negative then -value else value)
    until = i
    if i == first then -1 else i

  def toFloat: Float =
    if exponent < -LargestPower || exponent > LargestPower then slowFloat
    else
      // Three roundings: at most 2 units in the last place of a Double, far finer than a Float's
      // step, so rounding once more is right unless the Double lies that close to halfway between
      // two Floats.
      val d = mantissa.toDouble * NumberReader.PowersOfTen(exponent + LargestPower)
      val fromHalfway = (doubleToRawLongBits(d) & 0x1fffffffL) - 0x10000000L
      val isNormal = d < 3e38 && (d > 1.2e-38 || mantissa == 0)
      if !isNormal || Math.abs(fromHalfway) <= 8 then slowFloat
      else intBitsToFloat(floatToRawIntBits(d.toFloat) | (sign << 31))

  def toDouble: Double =
    // exact: both factors are Doubles, so there is one rounding
    if mantissa <= (1L << 53) && exponent <= 22 && exponent >= -22 then
      val m = mantissa.toDouble
      val power = NumberReader.PowersOfTen(Math.abs(exponent) + LargestPower)
      val d = if exponent < 0 then m / power else m * power
      if sign == 1 then -d else d
    else digits.toDouble

  /** Is the number whole, as `3`, `3.0` and `3e2` are? */
  def isWhole: Boolean =
    exponent >= 0 || { val d = toDouble; d == Math.rint(d) }

  /** Does the number, without its fraction, fit an Int? */
  def fitsInt: Boolean =
    if exponent == 0 then mantissa <= Int.MaxValue + sign.toLong
    else
      val d = toDouble; d > -2147483649.0 && d < 2147483648.0

  /** The number without its fraction; meaningful if [[fitsInt]]. */
  def toInt: Int =
    if exponent != 0 then toDouble.toInt else (mantissa.toInt ^ -sign) + sign

  private def slowFloat: Float = digits.toFloat
  private def digits: String = new String(source.bytes, from, until - from, ISO_8859_1)

  private inline def isDigit(c: Byte): Boolean = c >= '0' && c <= '9'
  private inline val EighteenDigits = 100000000000000000L
  private inline val LargestPower = 60

object NumberReader:
  /** 10 to the power −60 … 60. */
  private val PowersOfTen: Array[Double] = Array.tabulate(121)(i => s"1e${i - 60}".toDouble)

  /** 10 to the power 0 … 8. */
  private val Tens: Array[Long] = Array.iterate(1L, 9)(_ * 10)

  /** A number is read at once if so many bytes are there: for a sign, up to 7 digits, a point, 16
    * bytes of the fraction, and some to spare.
    */
  private inline val Ahead = 32

  private val Words: VarHandle =
    MethodHandles.byteArrayViewVarHandle(classOf[Array[Long]], ByteOrder.LITTLE_ENDIAN)

  // Eight characters at a time, the first in the lowest byte of a Long.
  // Source: Lemire, "Number parsing at a gigabyte per second", Software: Practice and Experience
  // 51(8), 2021, section 5.

  /** The characters from `at` on; a digit is its value, 0 to 9, all else is more than 9. */
  private inline def eight(bytes: Array[Byte], at: Int): Long =
    val word: Long = Words.get(bytes, at)
    word ^ 0x3030303030303030L

  /** How many of them, from the first on, are digits. */
  private inline def digits(word: Long): Int =
    // a sum's high bit is set by what exceeds 9; a carry disturbs only what comes after that
    numberOfTrailingZeros((word | (word + 0x7676767676767676L)) & 0x8080808080808080L) >>> 3

  /** The number of the first `count` of them, 1 to 8: pairs, then pairs of pairs. */
  private inline def value(word: Long, count: Int): Long =
    val digits = word << (64 - 8 * count) // zeros before the first
    val twos = (digits * (1 + (10 << 8))) >>> 8
    val fours = ((twos & 0x00ff00ff00ff00ffL) * (1 + (100 << 16))) >>> 16
    ((fours & 0x0000ffff0000ffffL) * (1 + (10000L << 32))) >>> 32

  /** Can a number or a word end before this byte? */
  inline def isDelimiter(c: Byte): Boolean =
    c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == ']' || c == '[' || c == '"' ||
      c == '#' || c == ','
