package candela.guiding

import candela.base.{CheckedInput, CheckedOutput}

/** What the passes so far tell of guiding.
  *
  * @param left   what guiding left of the variance in the last pass of enough paths
  * @param doubts passes one after the other, up to the last, in which it did not pay
  * @param gaveUp is nothing guided any more?
  * @param cost   rays of a path that isn't guided
  * @param effort of a guided one in the last pass of enough paths, in units of it, at least 1
  */
private[guiding] final case class GuideProgress(
    left: Option[Double] = None,
    doubts: Int = 0,
    gaveUp: Boolean = false,
    cost: Double = 1.0,
    effort: Double = 1.0
):
  import GuideProgress.*

  /** Did the last pass pay? */
  def pays: Boolean = left.exists(_ * effort < WorthIt)

  /** After another pass. One of few paths says nothing. */
  def after(verdict: GuideVerdict): GuideProgress =
    if verdict.paths < Enough then this
    else
      val next = copy(left = Some(verdict.left), effort = Math.max(1.0, verdict.cost / cost))
      next.copy(doubts = if next.pays then 0 else doubts + 1)

  def save(to: CheckedOutput): Unit =
    to.double(left.getOrElse(Unknown))
    to.int(doubts)
    to.int(if gaveUp then 1 else 0)
    to.double(cost)
    to.double(effort)

private[guiding] object GuideProgress:
  /** Paths by which a pass is judged. */
  val Enough = 10000

  /** Guiding pays if it leaves less of the variance, times what paths with branches cost more:
    * where rays are cheap, guided paths take up to 1.3 times as long.
    */
  val WorthIt = 0.75

  /** Passes in which it does not pay, until it is given up: the next fields are finer. */
  val MostDoubts = 2

  private val Unknown = -1.0

  def load(from: CheckedInput): GuideProgress =
    GuideProgress(
      left = Some(from.double()).filter(_ != Unknown),
      doubts = from.int(),
      gaveUp = from.int() == 1,
      cost = from.double(),
      effort = from.double()
    )
