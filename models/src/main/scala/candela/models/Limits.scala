package candela.models

import candela.diagnostics.{Code, SourcePos}

/** The range of a model's numbers. Beyond it, the nearer limit is used, with a warning. */
private[models] final case class Limits(min: Double, max: Double = Double.PositiveInfinity):
  override def toString: String =
    if max.isInfinite then s"at least ${Json.numberText(min)}"
    else s"from ${Json.numberText(min)} to ${Json.numberText(max)}"

  /** @param name of the member or statement */
  def apply(
      name: String,
      values: Vector[Double],
      at: SourcePos,
      session: Session
  ): Vector[Double] =
    val limited = values.map(x => Math.max(min, Math.min(max, x)))
    if limited != values then
      val message = s"`$name` must be $this, found ${Limits.text(values)}"
      session.warn(at, s"$message; using ${Limits.text(limited)}", Code.CorrectedValue)
    limited

private[models] object Limits:
  val Unit: Limits = Limits(0, 1)
  val NonNegative: Limits = Limits(0)

  def text(values: Vector[Double]): String = values.map(Json.numberText).mkString(" ")
