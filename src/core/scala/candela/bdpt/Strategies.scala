package candela.bdpt

import candela.aov.{LightParts, StrategyLayer}
import candela.color.Rgb
import candela.film.Splats
import candela.lights.LightGroups

/** The connection strategies of [[BidirectionalPathTracer]], whose light is to be told apart.
  *
  * @param maxDepth   of the tracer
  * @param isWeighted whether with the weights of MIS, so that they add up to the image; else each
  *                   alone has the light of all paths that it can find
  */
final class Strategies(maxDepth: Int, val isWeighted: Boolean):
  /** By depth, then by vertices of the light path. Light is not connected to the camera itself. */
  val layers: Vector[StrategyLayer] =
    for
      depth <- (0 to maxDepth).toVector
      s <- 0 to depth + 1
      if depth > 0 || s == 0
    yield StrategyLayer(s, depth + 2 - s)

  /** Those that bring light to the pixel of the camera path. */
  val groups: LightGroups =
    LightGroups(layers.filterNot(_.isSplatted).map(_.word), Array.empty, ofMedia = -1)

/** Records what each strategy brings to a sample. Mutable, one per worker.
  *
  * @param splats receives the light of paths that are connected to the camera
  */
private[bdpt] final class StrategyRecorder(strategies: Strategies, splats: Splats)
    extends SplatObserver:
  val parts: LightParts = LightParts(strategies.groups)

  def observe(x: Float, y: Float, light: Rgb, misRatios: Double, edges: Int): Unit =
    splats.addStrategy(x, y, imageValue(light, misRatios), edges - 1)

  /** Adds light of a path that ends at the camera's pixel.
    *
    * @param light     weighted
    * @param misRatios as in the weight 1 / (1 + others)
    */
  def add(s: Int, t: Int, light: Rgb, misRatios: Double): Unit =
    val value = imageValue(light, misRatios)
    if value.isFinite then
      val depth = s + t - 2
      // As in `groups`: of each depth, there is one strategy more than of that before
      parts.addToGroup(depth * (depth + 1) / 2 + s, value)

  private def imageValue(light: Rgb, misRatios: Double): Rgb =
    if strategies.isWeighted then light else light * (1 + misRatios).toFloat
