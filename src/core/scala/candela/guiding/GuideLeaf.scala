package candela.guiding

import candela.base.loop

/** A region of a field that is being built.
  *
  * @param region of the old field that it was, or was part of
  * @param of     places of its events among all
  * @param lit    part of all paths that has events
  * @param found  part of the region's events that found light
  * @param cost   rays that an event here brings about
  */
private[guiding] final class GuideLeaf(
    old: GuideField,
    region: Int,
    events: Array[Float],
    of: Array[Int],
    val centre: Array[Float],
    settings: GuideSettings,
    lit: Double,
    found: Float,
    cost: Float
):
  import GuideField.{Lobes, Size}
  import GuideLeaf.*
  import GuideRecords.*

  /** Its mixture. */
  var lobes: Array[Float] = old.lobes.slice(region * Lobes * Size, (region + 1) * Lobes * Size)

  /** The probability of BSDF sampling. */
  var bsdfProbability: Float = old.bsdfProbabilities(region)

  /** As in [[GuideField]]. */
  var splittingFactor: Float = old.splittingFactors(region)
  var measurement: Float = old.measurements(region)

  /** The root of the second moment of the light that paths find after an event here, over its cost;
    * 0: not known.
    */
  var effort = 0f

  /** Paths whose first event is here. */
  var paths = 0

  /** The sum of their relative variances, and what it would be without guiding. */
  var guidedNoise, unguidedNoise = 0.0

  private val isEnough = of.length >= GuideGrowth.Fewest
  private var isJudged = false

  /** Learns from the events all but the mixture, once. */
  def judge(): Unit =
    if isEnough && !isJudged then
      val light = GuideFit.meanLight(events, of)
      bsdfProbability = bestBsdfProbability(light)
      expect(light)
      compare()
    isJudged = true

  /** Learns from the events. */
  def grow(fit: GuideFit): Unit =
    judge()
    if isEnough then
      val start = if old.isFitted(region) then GuideFit.moved(old, region, centre) else null
      lobes = fit(of, centre, start)

  /** How much light paths find after an event here, and camera paths in all. Light that they found
    * before their first event does not depend on whether they find more.
    */
  private def expect(meanLight: Float): Unit =
    var earlierLight, squares = 0.0
    var count = 0
    loop(of.length): j =>
      val light = Math.min(events(of(j) + Light), BrightestEffort * meanLight)
      squares += light * light
      if events(of(j) + Total) > 0f then
        earlierLight += events(of(j) + EarlierLight)
        count += 1
    measurement = meanLight * found + (earlierLight / Math.max(1, count)).toFloat
    effort = Math.sqrt(squares / of.length * found / Math.max(1f, cost)).toFloat

  /** Compares paths as they are with those that would have sampled BSDFs alone, by the same paths.
    */
  private def compare(): Unit =
    var sum = 0.0
    loop(of.length): j =>
      val total = events(of(j) + Total)
      if total > 0f then
        sum += total
        paths += 1
    if paths > 0 then
      val mean = sum / paths
      var guided, unguided = 0.0
      loop(of.length): j =>
        val total = events(of(j) + Total).toDouble
        if total > 0.0 then
          val bsdfMoment = events(of(j) + Unguided).toDouble
          val limit = Brightest * mean
          val factor = limit * limit / Math.max(limit * limit, Math.max(total * total, bsdfMoment))
          guided += total * total * factor
          unguided += bsdfMoment * factor
      // In units of the squared mean of all paths from here; those without light count, too
      guidedNoise = Math.max(0.0, guided / (mean * mean) - lit * paths)
      unguidedNoise = Math.max(0.0, unguided / (mean * mean) - lit * paths)

  /** A half where that would have had the lesser second moment, by what the old field had learnt.
    * What it has not learnt is tried. Less than a half has outliers: rare directions count more.
    */
  private def bestBsdfProbability(meanLight: Float): Float =
    val isWorthwhile =
      !settings.adapts || !old.isFitted(region) ||
        moment(BsdfProbability, meanLight) < moment(1f, meanLight)
    if isWorthwhile then BsdfProbability else 1f

  private def moment(bsdfProbability: Float, meanLight: Float): Double =
    val limit = Brightest * meanLight
    var sum = 0.0
    loop(of.length): j =>
      val event = of(j)
      val light = Math.min(events(event + Light), limit)
      val pdf = bsdfProbability * events(event + BsdfPdf) + (1f - bsdfProbability) * events(
        event + GuidePdf
      )
      sum += light * light * events(event + Pdf) / pdf
    sum

private object GuideLeaf:
  /** More light counts as this much, in units of the region's mean. */
  val Brightest = 100f

  /** Likewise, in the second moment that decides how often paths split. */
  private val BrightestEffort = 20f

  /** Probability of BSDF sampling in guided regions. */
  val BsdfProbability = 0.5f
