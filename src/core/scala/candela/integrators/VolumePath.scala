package candela.integrators

import candela.color.{MutableRgb, Rgb}
import candela.media.PathWeights

/** What a path through media carries: throughput, and two kinds of densities, for each colour.
  * Media scatter colours at different distances, so a path that one colour has sampled is weighted
  * against those of the others ([[candela.media.PathWeights]]). Mutable.
  *
  * @param weights which media change on the way
  */
final class VolumePath(val weights: PathWeights = PathWeights()) extends PathState:

  /** Index of the medium around the path, −1: none. */
  var medium: Int = -1

  def throughput: Rgb = weights.throughput
  def scale(factor: Rgb): Unit = weights.scale(factor)
  def scale(factor: Float): Unit = weights.scale(factor)
  def absorb(): Unit = weights.scale(0f)
  def isDead: Boolean = weights.isDead
  def largest: Float = weights.throughput.largest
  def carried(radiance: Rgb, weight: Float): Rgb = weights.throughput * (radiance * weight)
  def addTo(sum: MutableRgb, radiance: Rgb, weight: Float): Unit =
    sum.add(carried(radiance, weight))

  def competes: Boolean = weights.lightDensity > 0f

  /** Densities are in units of the path's own. */
  def emissionWeight(choice: Float, pdf: Float): Float =
    LightTransport.powerHeuristic(1f, weights.lightDensity * choice * pdf)

  protected def turn(pdf: Float): Unit = weights.turn(pdf)

  def isAlone: Boolean = weights.isAlone
  def keepHero(): Unit = weights.keepHero()

  def another(): VolumePath = VolumePath()

  override def set(from: PathState): Unit =
    super.set(from)
    val same = from.asInstanceOf[VolumePath]
    weights.set(same.weights)
    medium = same.medium
