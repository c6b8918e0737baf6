package candela.scenefile

import java.lang.Double.doubleToRawLongBits
import java.lang.Float.{floatToRawIntBits, intBitsToFloat}
import java.lang.Long.numberOfTrailingZeros
import java.lang.invoke.{MethodHandles, VarHandle}
import java.nio.ByteOrder
import java.nio.charset.StandardCharsets.ISO_8859_1

/** Parses decimal numbers (`1`, `.5`, `-2.`, `+1e-3`) directly from bytes, without strings.
  *
  * Results are correctly rounded to the nearest Float or Double; `NumberReaderSuite` compares with
  * the JDK's parser.
  */
final class NumberReader(source: Source):
  private var tokenStart = 0
  private var tokenEnd = 0
  private var sign = 0
  private var mantissa = 0L
  private var exponent = 0

  /** End of the last scan: offset of the first byte that is not part of a number. */
  def stop: Int = tokenEnd

  /** Scans the number at `at`; the conversions below return the last number scanned. Returns the
    * offset after it, or −1 if there is no number or it isn't followed by a delimiter.
    */
  def scan(at: Int): Int =
    val bytes = source.bytes
    if source.limit - at < NumberReader.Ahead then scanSlowly(at)
    else
      val firstByte = bytes(at)
      sign = if firstByte == '-' then 1 else 0
      val digitsStart = at + sign
      val word = NumberReader.eight(bytes, digitsStart)
      val n = NumberReader.digits(word)
      val point = digitsStart + n
      val stop = bytes(point)
      tokenStart = at
      if n > 0 && NumberReader.isDelimiter(stop) && n < 8 then
        mantissa = NumberReader.value(word, n)
        exponent = 0
        tokenEnd = point
        point
      else if n > 0 && n < 8 && stop == '.' then
        mantissa = NumberReader.value(word, n)
        exponent = 0
        val end = fraction(bytes, point + 1)
        tokenEnd = end
        if end > point + 1 && NumberReader.isDelimiter(bytes(end)) then end else scanSlowly(at)
      else scanSlowly(at)

  /** Appends up to 11 fraction digits from `at`; returns the offset after them. */
  private def fraction(bytes: Array[Byte], at: Int): Int =
    val word = NumberReader.eight(bytes, at)
    val n = NumberReader.digits(word)
    if n > 0 then append(word, n)
    if n < 8 then at + n
    else
      val nextWord = NumberReader.eight(bytes, at + 8)
      val extraDigits = NumberReader.digits(nextWord).min(3)
      if extraDigits > 0 then append(nextWord, extraDigits)
      at + 8 + extraDigits

  private inline def append(word: Long, count: Int): Unit =
    mantissa = mantissa * NumberReader.Tens(count) + NumberReader.value(word, count)
    exponent -= count

  /** Byte-by-byte version of [[scan]], for rare forms: signs other than `-`, exponents, many
    * digits.
    */
  private def scanSlowly(at: Int): Int =
    val bytes = source.bytes
    val end = source.limit
    var i = at
    sign = if i < end && bytes(i) == '-' then 1 else 0
    if i < end && (sign == 1 || bytes(i) == '+') then i += 1
    // Digits after the 18th change the value by a factor below 1e-17, far less than a Double's ulp.
    var m = 0L
    var e = 0
    val digitsStart = i
    while i < end && isDigit(bytes(i)) do
      if m < EighteenDigits then m = m * 10 + (bytes(i) - '0') else e += 1
      i += 1
    var digits = i - digitsStart
    if i < end && bytes(i) == '.' then
      i += 1
      val fraction = i
      while i < end && isDigit(bytes(i)) do
        if m < EighteenDigits then
          m = m * 10 + (bytes(i) - '0')
          e -= 1
        i += 1
      digits += i - fraction
    tokenStart = at
    mantissa = m
    exponent = e
    tokenEnd = i
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
    val digitsStart = i
    var value = 0
    while i < end && isDigit(bytes(i)) do
      if value < 10000 then value = value * 10 + (bytes(i) - '0')
      i += 1
    exponent += (if negative then -value else value)
    tokenEnd = i
    if i == digitsStart then -1 else i

  def toFloat: Float =
    if exponent < -LargestPower || exponent > LargestPower then slowFloat
    else
      // Three roundings: at most 2 ulps of a Double, far less than a Float's ulp. One more rounding
      // is correct unless the Double is that close to halfway between two Floats.
      val d = mantissa.toDouble * NumberReader.PowersOfTen(exponent + LargestPower)
      val fromHalfway = (doubleToRawLongBits(d) & 0x1fffffffL) - 0x10000000L
      val isNormal = d < 3e38 && (d > 1.2e-38 || mantissa == 0)
      if !isNormal || Math.abs(fromHalfway) <= 8 then slowFloat
      else intBitsToFloat(floatToRawIntBits(d.toFloat) | (sign << 31))

  def toDouble: Double =
    // Exact operands, so a single rounding.
    if mantissa <= (1L << 53) && exponent <= 22 && exponent >= -22 then
      val m = mantissa.toDouble
      val power = NumberReader.PowersOfTen(Math.abs(exponent) + LargestPower)
      val d = if exponent < 0 then m / power else m * power
      if sign == 1 then -d else d
    else digits.toDouble

  /** Whether the number is an integer, as `3`, `3.0` and `3e2` are. */
  def isWhole: Boolean =
    exponent >= 0 || { val d = toDouble; d == Math.rint(d) }

  /** Whether the truncated number fits an Int. */
  def fitsInt: Boolean =
    if exponent == 0 then mantissa <= Int.MaxValue + sign.toLong
    else
      val d = toDouble; d > -2147483649.0 && d < 2147483648.0

  /** The truncated number; valid only if [[fitsInt]]. */
  def toInt: Int =
    if exponent != 0 then toDouble.toInt else (mantissa.toInt ^ -sign) + sign

  private def slowFloat: Float = digits.toFloat
  private def digits: String =
    new String(source.bytes, tokenStart, tokenEnd - tokenStart, ISO_8859_1)

  private inline def isDigit(c: Byte): Boolean = c >= '0' && c <= '9'
  private inline val EighteenDigits = 100000000000000000L
  private inline val LargestPower = 60

object NumberReader:
  /** Powers of ten from −60 to 60. */
  private val PowersOfTen: Array[Double] = Array.tabulate(121)(i => s"1e${i - 60}".toDouble)

  /** Powers of ten from 0 to 8. */
  private val Tens: Array[Long] = Array.iterate(1L, 9)(_ * 10)

  /** Bytes needed for the fast path: a sign, up to 7 digits, a point, 16 bytes of fraction, and a
    * margin.
    */
  private inline val Ahead = 32

  private val Words: VarHandle =
    MethodHandles.byteArrayViewVarHandle(classOf[Array[Long]], ByteOrder.LITTLE_ENDIAN)

  // SWAR parsing of eight characters, the first in the lowest byte of a Long. Source: Lemire,
  // "Number parsing at a gigabyte per second", Software: Practice and Experience 51(8), 2021,
  // section 5.

  /** Eight characters from `at`; digits map to 0 to 9, all others to more than 9. */
  private inline def eight(bytes: Array[Byte], at: Int): Long =
    val word: Long = Words.get(bytes, at)
    word ^ 0x3030303030303030L

  /** Number of leading digits. */
  private inline def digits(word: Long): Int =
    // The addition sets the high bit of bytes above 9; its carry affects only later bytes.
    numberOfTrailingZeros((word | (word + 0x7676767676767676L)) & 0x8080808080808080L) >>> 3

  /** Value of the first `count` digits, 1 to 8, combined in pairs, then pairs of pairs. */
  private inline def value(word: Long, count: Int): Long =
    val digits = word << (64 - 8 * count) // pads with leading zeros
    val twos = (digits * (1 + (10 << 8))) >>> 8
    val fours = ((twos & 0x00ff00ff00ff00ffL) * (1 + (100 << 16))) >>> 16
    ((fours & 0x0000ffff0000ffffL) * (1 + (10000L << 32))) >>> 32

  /** Whether a number or a word can end before this byte. */
  inline def isDelimiter(c: Byte): Boolean =
    c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == ']' || c == '[' || c == '"' ||
      c == '#' || c == ','
