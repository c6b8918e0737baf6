package candela.guiding

import candela.base.{CheckedInput, CheckedOutput}

/** What the passes so far tell of guiding.
  *
  * @param left   what guiding left of the variance in the last pass of enough paths; on average of
  *   the last two, if the one before did not tell clearly
  * @param effort rays of a guided path in that pass, in units of `cost`, at least 1; on average of
  *   the same two
  * @param doubts passes in which it did not pay, since it was certain that it does
  * @param proofs passes one after the other, up to the last, in which it paid
  * @param sure   was it ever certain that it pays?
  * @param silent passes of too few paths, one after the other, since it is certain no more
  * @param gaveUp is nothing guided any more?
  * @param cost   rays of a path that isn't guided
  * @param plain  relative variance of a path that isn't guided, as estimated by the first pass that
  *   paid
  * @param noise  relative variance of a path in the last pass of enough paths
  */
private[guiding] final case class GuideProgress(
    left: Option[Double] = None,
    effort: Double = 1.0,
    doubts: Int = 0,
    proofs: Int = 0,
    sure: Boolean = false,
    silent: Int = 0,
    gaveUp: Boolean = false,
    cost: Double = 1.0,
    plain: Option[Double] = None,
    noise: Double = 1.0
):
  import GuideProgress.*

  /** Did the last pass pay? */
  def pays: Boolean = paysBy(1.0)

  /** Is it certain enough for all paths to be guided? Else few of them try it once more: the first
    * field is coarse, and what few paths say of it is mostly too good.
    */
  def isCertain: Boolean = pays && (proofs > 1 || paysBy(Clear))

  /** @param factor of what it may leave */
  private def paysBy(factor: Double) =
    left.exists(part => part < factor * WorthIt && part * effort < factor * WorthRays)

  /** After another pass. One of few paths says nothing; several in which few are guided, since it
    * was certain, are a doubt. As much as two doubts says one with which it doesn't pay on average
    * after one that paid, but not clearly, and, before it was ever certain, one that leaves all of
    * the variance.
    */
  def after(verdict: GuideVerdict): GuideProgress =
    if verdict.paths < Enough then if sure && !isCertain then afterSilence else this
    else
      // Few paths tell it roughly: two tell it better
      val wasDoubtful = proofs > 0 && !isCertain
      def averaged(now: Double, before: => Double) = if wasDoubtful then (now + before) / 2 else now
      val next = copy(
        left = Some(averaged(verdict.left, left.get)),
        effort = averaged(effortOf(verdict), effort),
        noise = verdict.noise,
        silent = 0
      )
      if next.pays then
        val before = plain.orElse(Some(verdict.unguidedNoise))
        val proved = next.copy(proofs = proofs + 1, plain = before)
        if proved.isCertain then proved.copy(doubts = 0, sure = true) else proved
      else
        val isHopeless = !sure && verdict.left >= Hopeless
        val more = if wasDoubtful || isHopeless then MostDoubts else 1
        next.copy(doubts = doubts + more, proofs = 0)

  /** After several of these, what guiding leaves is not known any more. */
  private def afterSilence =
    if silent + 1 < MostSilent then copy(silent = silent + 1)
    else copy(left = None, doubts = doubts + 1, proofs = 0, silent = 0)

  private def effortOf(verdict: GuideVerdict) = Math.max(1.0, verdict.cost / cost)

  /** Has the field that was learnt from the pass before brought no more? What counts for equal time
    * is the variance of a path times its rays.
    */
  def isSettledBy(verdict: GuideVerdict): Boolean =
    val next = after(verdict)
    pays && next.pays && verdict.paths >= Enough &&
    next.noise * effortOf(verdict) > Settled * noise * effort

  /** What a guided path counts beside those of the first passes: the inverse of its variance, a
    * power of two. So products with it are exact, and one path more or less seldom changes it: it
    * should depend little on the paths that are averaged.
    *
    * Source: Müller, "Practical Path Guiding in Production", in Vorba et al., "Path Guiding in
    * Production", SIGGRAPH 2019 Courses.
    */
  def weight: Float = plain match
    case None => 1f
    case Some(before) =>
      val ratio = (before / Math.max(noise, before / MostWeight)).toFloat
      Math.scalb(1f, Math.max(0, Math.getExponent(ratio * Sqrt2)))

  def save(to: CheckedOutput): Unit =
    to.double(left.getOrElse(Unknown))
    to.double(effort)
    to.int(doubts)
    to.int(proofs)
    to.int(if sure then 1 else 0)
    to.int(silent)
    to.int(if gaveUp then 1 else 0)
    to.double(cost)
    to.double(plain.getOrElse(Unknown))
    to.double(noise)

private[guiding] object GuideProgress:
  /** Paths by which a pass is judged. */
  val Enough = 10000

  /** Guiding pays if it leaves less of the variance: guided rays take 1.4 to 1.6 times as long. */
  val WorthIt = 0.66

  /** It must also leave less than this of the variance times the effort. The product overstates
    * what branches cost, by up to a quarter: they share the path before them, and later fields are
    * finer.
    */
  val WorthRays = 1.1

  /** It clearly pays if it leaves as much less than that. */
  val Clear = 0.9

  /** Where it leaves as much as this before it was ever certain, a finer field won't help. */
  val Hopeless = 1.0

  /** Passes in which it does not pay, until it is given up: the next fields are finer. */
  val MostDoubts = 2

  /** Passes of too few paths that are a doubt. */
  val MostSilent = 2

  /** What another pass of learning must leave of the variance times the rays: it costs some percent
    * of its time.
    */
  private val Settled = 0.98

  /** So that a variance that was estimated too low does not discard all other passes. */
  private val MostWeight = 32.0

  private val Sqrt2 = Math.sqrt(2.0).toFloat

  private val Unknown = -1.0

  def load(from: CheckedInput): GuideProgress =
    GuideProgress(
      left = Some(from.double()).filter(_ != Unknown),
      effort = from.double(),
      doubts = from.int(),
      proofs = from.int(),
      sure = from.int() == 1,
      silent = from.int(),
      gaveUp = from.int() == 1,
      cost = from.double(),
      plain = Some(from.double()).filter(_ != Unknown),
      noise = from.double()
    )
