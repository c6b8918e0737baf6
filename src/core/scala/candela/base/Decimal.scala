package candela.base

/** Reads numbers in decimal notation. Java's parsers also read `1f`, `0x1p3`, `NaN` and `Infinity`.
  */
object Decimal:
  def float(text: String): Option[Float] = plain(text).flatMap(_.toFloatOption)
  def double(text: String): Option[Double] = plain(text).flatMap(_.toDoubleOption)

  private def plain(text: String): Option[String] =
    Option.when(text.forall(c => c >= '0' && c <= '9' || Marks.contains(c)))(text)

  private val Marks = "+-.eE"
