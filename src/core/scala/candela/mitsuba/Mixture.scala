package candela.mitsuba

import candela.diagnostics.Code

/** Blends, and Mitsuba 0.6's `mixturebsdf` and `mixturephase`. */
private[mitsuba] object Mixture:

  /** Says where Mitsuba 3 renders a blend otherwise, by an error of its own. */
  def warnOfSmooth(in: Properties, parts: Seq[Plugin]): Unit =
    if !in.plugin.isOld && parts.exists(isSmooth) then
      val message = "Mitsuba weighs the probability of a smooth part of a blend like a density; " +
        "its image differs, by up to 7 %"
      in.session.warn(Code.UnlikePbrt, in.pos, message)

  private def isSmooth(p: Plugin): Boolean =
    Smooth(p.name) || p.name == "twosided" && p.properties.map(_.value)
      .collect { case Value.Nested(inner) => inner }.exists(isSmooth)

  private val Smooth = Set("conductor", "dielectric", "thindielectric", "plastic")

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
