package candela.guiding

/** What the paths of a pass tell of guiding: their noise, as it is and as it would be if BSDFs
  * alone were sampled.
  *
  * @param paths    that were compared
  * @param guided   sum of their relative variances
  * @param unguided likewise, without guiding
  * @param cost     rays of a path
  */
private[guiding] final case class GuideVerdict(
    paths: Long,
    guided: Double,
    unguided: Double,
    cost: Double
):
  /** Relative variance of a path. */
  def noise: Double = guided / Math.max(1L, paths)

  /** The same, without guiding. */
  def unguidedNoise: Double = unguided / Math.max(1L, paths)

  /** What guiding leaves of the variance. */
  def varianceRatio: Double = if unguided > 0.0 then guided / unguided else 1.0
