package candela.report

import candela.measure.Interval

import java.util.Locale

/** Formats numbers in pages and charts, independently of the locale. */
private[candela] object Numbers:

  /** Four significant digits, with a power of ten for very small or large values: `0.01234`,
    * `1.234·10⁻⁵`.
    */
  def short(value: Double): String =
    if value == 0 then "0"
    else if value.isInfinite || value.isNaN then "–"
    else
      val exponent = Math.floor(Math.log10(Math.abs(value))).toInt
      if exponent >= -4 && exponent < 5 then
        val digits = Math.max(0, 3 - exponent)
        s"%.${digits}f".formatLocal(Locale.ROOT, value)
      else s"${fixed(value / Math.pow(10, exponent), 3)}·10${raised(exponent)}"

  def fixed(value: Double, digits: Int): String = s"%.${digits}f".formatLocal(Locale.ROOT, value)

  /** Of a share: `0.3 %`, `23 %`. */
  def percentage(share: Double): String =
    s"${fixed(100 * share, if share < 0.0995 then 1 else 0)} %"

  /** The estimate with half the interval's width, if known. */
  def plusMinus(i: Interval, number: Double => String): String =
    if i.isKnown then s"${number(i.estimate)} ± ${number((i.high - i.low) / 2)}"
    else number(i.estimate)

  /** The estimate with its interval, if known: for what can't be negative. */
  def range(i: Interval): String =
    val limits =
      if !i.isKnown || (i.low == i.high && i.low == i.estimate) then ""
      else if i.isBounded && i.low > 0 then s" (${short(i.low)} to ${short(i.high)})"
      else if i.isBounded then s" (at most ${short(i.high)})"
      else if i.low > 0 then s" (at least ${short(i.low)})"
      else " (no limits)"
    short(i.estimate) + limits

  /** Label of a logarithmic axis tick: `0.01`, `10`, `10⁻⁵`. */
  def tick(value: Double): String =
    val exponent = Math.floor(Math.log10(value) + 1e-9).toInt
    if exponent >= -3 && exponent <= 4 then
      val isRound = Math.abs(value / Math.pow(10, exponent) % 1) < 1e-6
      s"%.${Math.max(0, if isRound then -exponent else 1 - exponent)}f"
        .formatLocal(Locale.ROOT, value)
    else
      val digits = fixed(value / Math.pow(10, exponent), 1).stripSuffix(".0")
      if digits == "1" then s"10${raised(exponent)}" else s"${digits}·10${raised(exponent)}"

  /** A number of trials: all digits if it has few, else a power of ten: `1000`, `2.5·10⁷`. */
  def count(n: Long): String =
    if n < 10000 then n.toString
    else
      // Three digits, before the power is known: 99,999 is 10⁵
      val step = Math.pow(10, Math.floor(Math.log10(n.toDouble)) - 2)
      val rounded = Math.round(n / step) * step
      val exponent = Math.floor(Math.log10(rounded) + 1e-9).toInt
      val digits =
        fixed(rounded / Math.pow(10, exponent), 2).stripSuffix("0").stripSuffix("0")
      if digits == "1." then s"10${raised(exponent)}"
      else s"${digits.stripSuffix(".")}·10${raised(exponent)}"

  private def raised(n: Int): String = n.toString.map:
    case '-' => '⁻'
    case digit => "⁰¹²³⁴⁵⁶⁷⁸⁹" (digit - '0')
