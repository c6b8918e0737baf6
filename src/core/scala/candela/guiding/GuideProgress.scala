package candela.guiding

import candela.io.{CheckedInput, CheckedOutput}

/** What the passes so far tell of guiding. Only passes of enough paths are evaluated.
  *
  * @param passes evaluated
  * @param ratio time to the same noise, in units of that of unguided paths: the geometric mean of
  *   the last evaluated pass and of all before. Guiding pays below 1
  * @param varianceRatio what guiding left of the variance in the last evaluated pass
  * @param effort rays of a guided path in that pass, in units of `cost`, at least 1
  * @param gaveUp is nothing guided any more?
  * @param cost rays of a path that isn't guided
  * @param plain relative variance of a path that isn't guided, as estimated by the first pass that
  *   paid
  * @param noise relative variance of a path in the last evaluated pass
  */
private[guiding] final case class GuideProgress(
    passes: Int = 0,
    ratio: Option[Double] = None,
    varianceRatio: Option[Double] = None,
    effort: Double = 1.0,
    gaveUp: Boolean = false,
    cost: Double = 1.0,
    plain: Option[Double] = None,
    noise: Double = 1.0
):
  import GuideProgress.*

  def isWorthwhile: Boolean = ratio.exists(_ < 1.0)

  /** Two passes decide, or one that is clear. Until then few paths are guided: the first field is
    * coarse, and what few paths say of it is mostly too good.
    */
  def isDecided: Boolean = passes > 1 || ratio.exists(r => r < ClearGain || r >= ClearLoss)

  /** Are all paths guided? */
  def isCertain: Boolean = isWorthwhile && isDecided

  /** After another pass. */
  def after(verdict: GuideVerdict): GuideProgress =
    if verdict.paths < MinPaths then this
    else
      val newRatio = ratioOf(verdict)
      copy(
        passes = passes + 1,
        ratio = Some(ratio.fold(newRatio)(oldRatio => Math.sqrt(oldRatio * newRatio))),
        varianceRatio = Some(verdict.varianceRatio),
        effort = effortOf(verdict),
        plain = plain.orElse(Option.when(newRatio < 1.0)(verdict.unguidedNoise)),
        noise = verdict.noise
      )

  /** @param isLast does nothing learn any more? */
  def givesUp(isLast: Boolean): Boolean = ratio.exists(_ >= 1.0) && (isDecided || isLast)

  private def effortOf(verdict: GuideVerdict) = Math.max(1.0, verdict.cost / cost)

  private def ratioOf(verdict: GuideVerdict) =
    verdict.varianceRatio * Math.max(TimeOfRay, effortOf(verdict) / BranchCostFactor)

  /** Has the field that was learnt from the pass before brought no more? What counts for equal time
    * is the variance of a path times its rays.
    */
  def isSettledBy(verdict: GuideVerdict): Boolean =
    isWorthwhile && ratioOf(verdict) < 1.0 && verdict.paths >= MinPaths &&
      verdict.noise * effortOf(verdict) > MaxSettledRatio * noise * effort

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
      val ratio = (before / Math.max(noise, before / MaxWeight)).toFloat
      Math.scalb(1f, Math.max(0, Math.getExponent(ratio * Sqrt2)))

  def save(to: CheckedOutput): Unit =
    to.int(passes)
    for value <- Vector(ratio, varianceRatio, plain) do to.double(value.getOrElse(Unknown))
    to.double(effort)
    to.int(if gaveUp then 1 else 0)
    to.double(cost)
    to.double(noise)

private[guiding] object GuideProgress:
  /** Paths of a pass that is evaluated. */
  private val MinPaths = 10000

  /** Guided rays take 1.4 to 1.6 times as long. */
  private val TimeOfRay = 1.5

  /** The number of rays overstates what branches cost, by up to a quarter: they share the path
    * before them, and later fields are finer.
    */
  private val BranchCostFactor = 1.1

  /** Ratios by which the first evaluated pass decides: beyond the second, guiding leaves all of the
    * variance, and a finer field won't help.
    */
  private val ClearGain = 0.9
  private val ClearLoss = 1.5

  /** What another pass of learning must leave of the variance times the rays: it costs some percent
    * of its time.
    */
  private val MaxSettledRatio = 0.98

  /** So that a variance that was estimated too low does not discard all other passes. */
  private val MaxWeight = 32.0

  private val Sqrt2 = Math.sqrt(2.0).toFloat

  private val Unknown = -1.0

  def load(from: CheckedInput): GuideProgress =
    val passes = from.int()
    def optional() = Some(from.double()).filter(_ != Unknown)
    val (ratio, varianceRatio, plain) = (optional(), optional(), optional())
    GuideProgress(
      passes,
      ratio,
      varianceRatio,
      effort = from.double(),
      gaveUp = from.int() == 1,
      cost = from.double(),
      plain,
      noise = from.double()
    )
