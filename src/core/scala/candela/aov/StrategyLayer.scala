package candela.aov

import java.util.Locale

/** Light of one strategy of bidirectional path tracing: of paths with `s` vertices from a light and
  * `t` from the camera.
  */
final case class StrategyLayer(s: Int, t: Int) extends ImageLayer:
  /** Scattering events of the paths. */
  def depth: Int = s + t - 2

  /** As pbrt names its files. */
  def word: String = "bdpt_d%02d_s%02d_t%02d".formatLocal(Locale.ROOT, depth, s, t)

  /** Whether light paths are connected to the camera, and their light to any pixel. */
  def isSplatted: Boolean = t == 1

  def channelsOf(groups: Vector[String]): Vector[String] =
    Vector("R", "G", "B").map(c => s"$word.$c")

  private[aov] def statisticOf(groups: Vector[String]): Statistic =
    if isSplatted then Statistic.SplatsOnly
    else Statistic.ScaledMeanOfAll(Tally.light(LightParts.Groups + groups.indexOf(word)))

  override def isLight: Boolean = true
