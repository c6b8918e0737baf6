package candela.build.recipe

import candela.base.indexWhere
import candela.diagnostics.Code
import candela.scenefile.Param

/** Which numbers a parameter takes. NaN is an error, and so is infinity unless it is within.
  *
  * @param opensLow  whether `least` itself is outside
  * @param opensHigh whether `most` itself is outside
  * @param also      a number that is taken as well, such as 0 for none
  */
final case class Range(
    least: Float,
    most: Float,
    outside: Outside = Outside.Refused,
    opensLow: Boolean = false,
    opensHigh: Boolean = false,
    also: Option[Float] = None
):
  def limited: Range = copy(outside = Outside.Limited)
  def unclamped: Range = copy(outside = Outside.Unclamped)
  def deferred: Range = copy(outside = Outside.Deferred)
  def including(other: Float): Range = copy(also = Some(other))

  private def isWide: Boolean = least <= -Range.Largest && most >= Range.Largest

  private def holds(x: Float): Boolean =
    val isAbove = if opensLow then x > least else x >= least
    val isBelow = if opensHigh then x < most else x <= most
    isAbove && isBelow || also.contains(x)

  /** As text; empty if all numbers are within. */
  def text: String = text("at least", "from ")

  /** As text for tables. */
  def brief: String = text("≥", "")

  private def text(atLeast: String, from: String): String =
    def n(x: Float) = DefaultText.number(x)
    val low = s"${if opensLow then "above" else atLeast} ${n(least)}"
    val high = s"${if opensHigh then "below" else "at most"} ${n(most)}"
    val words =
      if isWide then ""
      else if most >= Range.Largest then low
      else if least <= -Range.Largest then high
      else if opensLow && opensHigh then s"between ${n(least)} and ${n(most)}"
      else if opensLow || opensHigh then s"$low and $high"
      else s"$from${n(least)} to ${n(most)}"
    also.fold(words)(x => s"${n(x)} or $words")

  /** The parameter with numbers that its recipe can use; None if it is one, after an error. */
  def held(p: Param, unit: String, site: Site): Option[Param] =
    def isOdd(x: Float) = !holds(x) && (outside != Outside.Deferred || Range.isAbsurd(x))
    def first(isSuch: Float => Boolean) =
      indexWhere(p.floats.length)(i => isSuch(p.floats(i))) match
        case -1 => p.ints.iterator.map(_.toFloat).find(isSuch)
        case i => Some(p.floats(i))
    first(isOdd) match
      case None => Some(p)
      case Some(odd) =>
        val worst = first(x => isOdd(x) && !java.lang.Float.isFinite(x)).getOrElse(odd)
        corrected(p, worst, unit, site)

  private def corrected(p: Param, odd: Float, unit: String, site: Site): Option[Param] =
    val isAbsurd = Range.isAbsurd(odd)
    val isOne = p.floats.length + p.ints.length == 1
    val measure = if unit.nonEmpty && unit.forall(_.isLetter) then s" $unit" else ""
    val words =
      if isWide || isAbsurd && outside != Outside.Refused then
        s"within ±${DefaultText.number(Range.Largest)}"
      else s"$text$measure"
    val value = if odd.isNaN then "NaN" else DefaultText.number(odd)
    def message(verb: String) = s"`${p.name}` $verb be $words, found $value"
    def nearest(x: Float): Float =
      if holds(x) then x
      else if outside == Outside.Limited then Math.max(least, Math.min(most, x))
      else Math.max(-Range.Largest, Math.min(Range.Largest, x))
    if !java.lang.Float.isFinite(odd) || outside == Outside.Refused then
      site.problems.error(Code.ParameterValue, p.valuesAt, message("must"))
      // Lest what needs the parameter say that it is missing
      Option.unless(isOne)(p.mapped(x => if holds(x) then x else 0f))
    else
      if nearest(odd) == odd then
        val warning = s"${message("should")}, which is not clamped"
        site.problems.warn(Code.ParameterValue, p.valuesAt, warning)
      else
        val instead = if isOne then DefaultText.number(nearest(odd)) else "the nearest that is"
        site.problems.warn(Code.CorrectedValue, p.valuesAt, s"${message("must")}; using $instead")
      Some(p.mapped(nearest))

/** What becomes of numbers outside a range. */
enum Outside:
  case Refused

  /** The nearest limit is used, with a warning. */
  case Limited

  /** They are used, with a warning. */
  case Unclamped

  /** They are used, and the recipe says what becomes of them. */
  case Deferred

object Range:
  /** What is larger has squares and products that no Double holds. */
  val Largest = 1e30f

  /** All numbers; what is larger is limited. */
  val Any: Range = Range(-Largest, Largest).limited

  /** All numbers, and infinity. */
  val Unlimited: Range = Range(Float.NegativeInfinity, Float.PositiveInfinity)

  /** Above 0, and infinity. */
  val endless: Range = Range(0f, Float.PositiveInfinity, opensLow = true)

  /** Roughness and the like; what is negative is 0. */
  val nonNegative: Range = Range(0f, Largest).limited

  def atLeast(least: Float): Range = Range(least, Largest)
  def above(least: Float): Range = Range(least, Largest, opensLow = true)
  def exclusive(least: Float, most: Float): Range =
    Range(least, most, opensLow = true, opensHigh = true)

  private def isAbsurd(x: Float) = !(Math.abs(x) <= Largest)
