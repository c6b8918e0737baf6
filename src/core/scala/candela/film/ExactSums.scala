package candela.film

import candela.base.loop
import candela.io.{CheckedInput, CheckedOutput}
import java.math.BigDecimal

/** Sums of numbers without any rounding, so that neither the order of the additions nor their
  * division among machines matters. Numbers that are not finite don't count.
  *
  * A sum is the unevaluated sum of two Doubles: each addition's rounding error is computed and
  * added to the second, which takes memory from the first such error on: a single sample has none.
  * A third part, of arbitrary precision, is used only if values differ by more than some 100 binary
  * digits. One worker at a time owns a sum.
  *
  * Source: Knuth, "The Art of Computer Programming", vol. 2, §4.2.2, theorem B; Shewchuk, "Adaptive
  * Precision Floating-Point Arithmetic", Discrete & Computational Geometry 18, 1997.
  */
final class ExactSums(val size: Int):
  private val high = new Array[Double](size)
  private val lows =
    new Array[Array[Double] | Null]((size + ExactSums.BlockSize - 1) / ExactSums.BlockSize)
  @volatile private var thirdParts = Map.empty[Int, BigDecimal]

  private def low(at: Int): Double =
    val block = lows(at / ExactSums.BlockSize)
    if block == null then 0.0 else block(at % ExactSums.BlockSize)

  /** The second parts of the sums around `at`. Read without a lock: a racing thread sees null and
    * takes the lock, or the array with its zeros. Only who owns a sum writes its element.
    */
  private def lowsOf(at: Int): Array[Double] =
    val block = lows(at / ExactSums.BlockSize)
    if block != null then block else makeLows(at / ExactSums.BlockSize)

  private def makeLows(index: Int): Array[Double] = lows.synchronized:
    val block = lows(index)
    if block != null then block
    else
      val created =
        new Array[Double](Math.min(ExactSums.BlockSize, size - index * ExactSums.BlockSize))
      lows(index) = created
      created

  def add(at: Int, value: Double): Unit =
    val h = high(at)
    val sum = h + value
    // Facts of surfaces may be infinite, such as coordinates; they don't count
    if Math.abs(sum) <= Double.MaxValue then
      high(at) = sum
      val error = ExactSums.error(h, value, sum)
      if error != 0.0 then addLow(at, error)

  private def addLow(at: Int, value: Double): Unit =
    val block = lowsOf(at)
    val inBlock = at % ExactSums.BlockSize
    val l = block(inBlock)
    val sum = l + value
    block(inBlock) = sum
    val error = ExactSums.error(l, value, sum)
    if error != 0.0 then
      // Moves what the high part can hold there, which makes room
      val h = high(at)
      high(at) = h + sum
      val moved = ExactSums.error(h, sum, high(at))
      block(inBlock) = moved + error
      val thirdPart = ExactSums.error(moved, error, block(inBlock))
      if thirdPart != 0.0 then addThirdPart(at, BigDecimal(thirdPart))

  private def addThirdPart(at: Int, value: BigDecimal): Unit = lows.synchronized:
    thirdParts = thirdParts.updated(at, thirdParts.get(at).fold(value)(_.add(value)))

  /** The sum, rounded once. */
  def apply(at: Int): Double =
    if thirdParts.isEmpty || !thirdParts.contains(at) then high(at) + low(at)
    else exact(at).doubleValue

  /** Adds the sums from `from` on to `to` at `at`, each rounded once. */
  def addTo(to: Array[Double], at: Int, from: Int, count: Int): Unit =
    if thirdParts.isEmpty then loop(count)(i => to(at + i) += high(from + i) + low(from + i))
    else loop(count)(i => to(at + i) += this(from + i))

  /** The difference of the sum and its rounded value, rounded. */
  def remainder(at: Int): Double =
    if thirdParts.isEmpty || !thirdParts.contains(at) then
      ExactSums.error(high(at), low(at), high(at) + low(at))
    else
      val total = exact(at)
      total.subtract(BigDecimal(total.doubleValue)).doubleValue

  private def exact(at: Int): BigDecimal =
    BigDecimal(high(at)).add(BigDecimal(low(at))).add(thirdParts.getOrElse(at, BigDecimal.ZERO))

  /** Adds all sums of `other`, or subtracts them. */
  def add(other: ExactSums, isNegative: Boolean = false): Unit =
    require(size == other.size, s"$size sums, and ${other.size}")
    val sign = if isNegative then -1.0 else 1.0
    loop(size): i =>
      add(i, sign * other.high(i))
      add(i, sign * other.low(i))
    for (i, value) <- other.thirdParts do
      addThirdPart(i, if isNegative then value.negate else value)

  /** Bytes in use, but for the third parts. */
  def memory: Long =
    8L * size + lows.map(block => if block == null then 0L else 8L * block.length).sum

  /** Writes the sums, in a form that depends on their values only: the rounded sums, the rounded
    * remainders, and what these leave of some, as decimal numbers.
    */
  def save(to: CheckedOutput): Unit =
    loop(size)(i => to.double(this(i) + 0.0)) // no negative zeros
    loop(size)(i => to.double(remainder(i) + 0.0))
    val remaining = Vector.newBuilder[(Int, BigDecimal)]
    for i <- thirdParts.keys do
      val value = exact(i).subtract(BigDecimal(this(i))).subtract(BigDecimal(remainder(i)))
      if value.signum != 0 then remaining += i -> value
    val sorted = remaining.result().sortBy(_._1)
    to.int(sorted.size)
    for (i, value) <- sorted do
      to.int(i)
      to.text(value.stripTrailingZeros.toString)

  /** Adds saved sums. */
  def load(from: CheckedInput): Unit =
    loop(size)(i => add(i, from.double()))
    loop(size)(i => add(i, from.double()))
    loop(from.count(bytes = 8)): _ =>
      val index = from.int()
      require(index >= 0 && index < size, s"there is no sum $index")
      addThirdPart(index, ExactSums.parse(from.text()))

object ExactSums:
  /** So many sums get their second parts together: a power of two. */
  private inline val BlockSize = 2048

  /** Decimal digits, before or behind the point, of numbers that are sums of Doubles. */
  private val MaxDigits = 1100

  /** What two Doubles leave of a sum; of other numbers, sums may fill the memory. */
  private def parse(text: String): BigDecimal =
    require(text.length <= 2 * MaxDigits, s"a number of ${text.length} digits")
    val value = BigDecimal(text)
    require(Math.abs(value.scale) <= MaxDigits, s"a number of ${value.scale} decimal places")
    value

  /** The rounding error of `sum` = `a` + `b`; exact. */
  inline def error(a: Double, b: Double, sum: Double): Double =
    val fromB = sum - a
    (a - (sum - fromB)) + (b - fromB)
