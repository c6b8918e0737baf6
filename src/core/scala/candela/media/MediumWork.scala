package candela.media

import candela.sampling.RandomStream

/** Scratch memory of media traversals, one per worker. */
final class MediumWork:
  val random = RandomStream()

  /** Weights of the camera path, and of the light sampled at one of its vertices. */
  val weights = PathWeights()
  val shadow = PathWeights()

  private[media] val walk = MajorantWalk()
  private[media] val point = MediumPoint()

  /** Radiance emitted by media along the path towards the camera. */
  var glowR, glowG, glowB = 0f

  def start(hero: Int): Unit =
    weights.start(hero, 0f)
    glowR = 0f
    glowG = 0f
    glowB = 0f
