package candela.base

import java.util.Locale

/** Formats numbers for display, independently of the locale. */
object Figures:

  /** Three significant digits with a metric prefix: `1.31 M`, `950`, `12.0 k`. */
  def metric(value: Double): String =
    val (scaled, prefix) =
      if value >= 1e9 then (value / 1e9, " G")
      else if value >= 1e6 then (value / 1e6, " M")
      else if value >= 1e3 then (value / 1e3, " k")
      else (value, "")
    val digits = if scaled >= 100 || prefix.isEmpty then 0 else if scaled >= 10 then 1 else 2
    fixed(scaled, digits) + prefix

  /** `0.04 s`, `3.2 s`, `1:05`, `2:00:10`. */
  def duration(seconds: Double): String =
    if seconds < 0.995 then s"${fixed(seconds, 2)} s"
    else if seconds < 59.95 then s"${fixed(seconds, 1)} s"
    else clock(seconds)

  /** Minutes and seconds, and hours if not zero: `0:07`, `12:00`, `1:00:00`. */
  def clock(seconds: Double): String =
    val s = Math.round(seconds)
    if s < 3600 then "%d:%02d".formatLocal(Locale.ROOT, s / 60, s % 60)
    else "%d:%02d:%02d".formatLocal(Locale.ROOT, s / 3600, s / 60 % 60, s % 60)

  def fixed(value: Double, digits: Int): String = s"%.${digits}f".formatLocal(Locale.ROOT, value)

  def scientific(value: Double): String = "%.4g".formatLocal(Locale.ROOT, value)

  /** Nine significant digits, as C prints with `%.9g`. */
  def general(value: Double): String =
    val rounded = java.math.BigDecimal(value).round(java.math.MathContext(9)).stripTrailingZeros
    if Math.abs(value) >= 1e-4 && Math.abs(value) < 1e9 then rounded.toPlainString
    else rounded.toString.replace('E', 'e')

  /** `1.23 %`: three digits, or fewer. */
  def percentage(part: Double): String =
    if !part.isFinite then "unknown"
    else general(BigDecimal(100 * part).round(java.math.MathContext(3)).toDouble) + " %"

  /** `1 error`, `2 errors`. */
  def count(n: Long, noun: String): String = if n == 1 then s"1 $noun" else s"$n ${noun}s"
