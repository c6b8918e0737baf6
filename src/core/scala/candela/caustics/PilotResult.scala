package candela.caustics

import java.util.Locale

/** What a pilot has found out.
  *
  * @param choice       what it would do, if it can do anything
  * @param expectedWork expected relative variance of a sample, times its rays relative to those of
  *                     the camera's paths alone
  * @param pays         is it better to do it?
  * @param why          in words
  */
final case class PilotResult(
    choice: Option[CausticChoice],
    expectedWork: Double,
    pays: Boolean,
    why: String
):
  /** What is done, and what is said of it. */
  def result: (Option[CausticChoice], String) =
    if pays then (choice, why) else (None, s"none: $why")

  /** The better of both, which is this one unless the other is `margin` times as good. */
  def better(other: PilotResult, margin: Double): PilotResult =
    if other.pays && !(pays && expectedWork < margin * other.expectedWork) then other
    else if pays then this
    else copy(why = s"$why; ${other.why}")

private[candela] object PilotResult:
  /** Expected efficiency from which on something is done. Pilots are not exact: what paths would
    * have found once in a billion samples counts for them, too, and fireflies may be missed. And
    * guiding, which photons exclude, may bring as much.
    */
  inline val MinGain = 3.0

  /** Nothing can be done. */
  def none(why: String): PilotResult = PilotResult(None, Double.PositiveInfinity, pays = false, why)

  /** @param baseline,expectedWork variance times rays, without it and with it
    * @param mustPay     is it done only if it pays?
    */
  def of(
      choice: CausticChoice,
      baseline: Double,
      expectedWork: Double,
      mustPay: Boolean = true
  ): PilotResult =
    val gain = if expectedWork > 0.0 then baseline / expectedWork else 1.0
    val times = if gain > 10.0 then "more than 10" else "%.2f".formatLocal(Locale.ROOT, gain)
    val reason = s"the pilot expects $times times the efficiency, with $choice"
    PilotResult(Some(choice), expectedWork, !mustPay || gain > MinGain, reason)
