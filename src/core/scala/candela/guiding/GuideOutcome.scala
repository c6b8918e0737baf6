package candela.guiding

/** What was learnt in a rendering, and what it brought.
  *
  * @param samples per pixel, from which it was learnt
  * @param regions that are guided
  * @param allRegions of space, guided or not
  * @param lobes of the guided regions
  * @param bounces off surfaces that are not specular
  * @param guided of these, those that were guided
  * @param varianceRatio with guiding over without, by the paths of the last pass that learnt from
  *                      enough of them
  * @param weight of the last samples, relative to the first
  * @param gaveUp was guiding given up because it did not pay?
  */
final case class GuideOutcome(
    samples: Int,
    regions: Int,
    allRegions: Int,
    lobes: Int,
    bounces: Long,
    guided: Long,
    varianceRatio: Option[Double],
    weight: Float,
    gaveUp: Boolean
):
  /** Part of the bounces that were guided. */
  def share: Double = if bounces > 0 then guided.toDouble / bounces else 0.0
