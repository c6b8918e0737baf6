package candela.guiding

import candela.base.{CheckedInput, CheckedOutput}

/** What the passes so far tell of guiding.
  *
  * @param left   what guiding left of the variance in the last pass of enough paths
  * @param doubts passes one after the other, up to the last, in which it did not pay
  * @param gaveUp is nothing guided any more?
  */
private[guiding] final case class GuideProgress(
    left: Option[Double] = None,
    doubts: Int = 0,
    gaveUp: Boolean = false
):
  import GuideProgress.*

  /** Did the last pass pay? */
  def pays: Boolean = left.exists(_ < WorthIt)

  /** After another pass. One of few paths says nothing. */
  def after(verdict: GuideVerdict): GuideProgress =
    if verdict.paths < Enough then this
    else copy(Some(verdict.left), if verdict.left < WorthIt then 0 else doubts + 1)

  def save(to: CheckedOutput): Unit =
    to.double(left.getOrElse(Unknown))
    to.int(doubts)
    to.int(if gaveUp then 1 else 0)

private[guiding] object GuideProgress:
  /** Paths by which a pass is judged. */
  val Enough = 10000

  /** Guiding pays if it leaves less of the variance: where rays are cheap, guided paths take up to
    * 1.3 times as long.
    */
  val WorthIt = 0.75

  /** Passes in which it does not pay, until it is given up: the next fields are finer. */
  val MostDoubts = 2

  private val Unknown = -1.0

  def load(from: CheckedInput): GuideProgress =
    GuideProgress(Some(from.double()).filter(_ != Unknown), from.int(), from.int() == 1)
