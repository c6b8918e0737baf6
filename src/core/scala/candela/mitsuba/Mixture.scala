package candela.mitsuba

import candela.diagnostics.Code

/** Mitsuba 0.6's `mixturebsdf` and `mixturephase`. */
private[mitsuba] object Mixture:

  /** Weights of so many parts, which sum to at most 1; None, after an error, if they don't fit. */
  def weights(in: Properties, count: Int, kind: String): Option[Vector[Double]] =
    val text = in.text("weights", "")
    val read = in.session.attempt(Values.numbers(text.replace(';', ' '), in.posOf("weights")))
    read.flatMap: weights =>
      val total = weights.sum
      if weights.size != count || weights.exists(_ < 0) || !(total > 0) then
        in.session.error(
          Code.ParameterCount,
          in.posOf("weights"),
          s"`weights` of ${in.plugin.description} must be $count numbers, one for each $kind, at " +
            s"least 0, and not all 0, found `$text`"
        )
        None
      else if total <= 1 + 1e-6 then Some(weights)
      else
        in.session.warn(
          Code.CorrectedValue,
          in.posOf("weights"),
          s"`weights` of ${in.plugin.description} sum to more than 1; they are scaled"
        )
        Some(weights.map(_ / total))
