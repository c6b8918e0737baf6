package candela.media

import candela.color.Rgb
import candela.geometry.Ray
import candela.sampling.{HenyeyGreenstein, RandomStream}

/** What fills space between surfaces, and scatters, absorbs or emits light there. Immutable.
  *
  * Scattering is decided by chance, absorption is a weight: what only absorbs makes no noise where
  * its transmittance is known, and little where it must be estimated.
  */
abstract class Medium:
  val phase: HenyeyGreenstein

  /** Follows the camera's path along `ray`, as far as `ray.tMax`, to where the medium scatters it.
    * Changes `work.weights` to what is left, and adds to `work`'s glow what the medium emits on the
    * way.
    *
    * @param first a number in [0, 1) of the path's sampler, for the first collision
    * @param emits is the medium's own light to be added?
    * @return the ray's parameter where it is scattered; −1: nowhere
    */
  def follow(ray: Ray, first: Float, emits: Boolean, work: MediumWork): Float

  /** Changes `work.shadow` to what arrives of light along `ray`, as far as `ray.tMax`. */
  def dim(ray: Ray, work: MediumWork): Unit

  /** Does it treat colours differently? */
  def isChromatic: Boolean

  def isEmissive: Boolean

  /** For the plan. */
  def describe: String

object Medium:
  /** Do these coefficients treat colours differently? */
  private[media] def isChromatic(absorption: Rgb, scattering: Rgb): Boolean =
    Seq(absorption + scattering, scattering).exists(c => c.r != c.g || c.g != c.b)

/** Coefficients at one place, per scene unit; mutable. Emission is that of the place, per length:
  * the absorption coefficient times the radiance that the medium would have if it were opaque.
  */
final class MediumPoint:
  var absorbR, absorbG, absorbB = 0f
  var scatterR, scatterG, scatterB = 0f
  var glowR, glowG, glowB = 0f

  /** Those of a medium where it is `density` times as dense; `glow` stays as it is. */
  def setDensity(density: Float, absorption: Rgb, scattering: Rgb): Unit =
    absorbR = density * absorption.r
    absorbG = density * absorption.g
    absorbB = density * absorption.b
    scatterR = density * scattering.r
    scatterG = density * scattering.g
    scatterB = density * scattering.b

/** Work space of walks through media, one per worker. */
final class MediumWork:
  val random = RandomStream()

  /** Of the path from the camera, and of the light that is sampled at one of its points. */
  val weights = PathWeights()
  val shadow = PathWeights()

  private[media] val walk = MajorantWalk()
  private[media] val point = MediumPoint()

  /** Light that media on the path emitted towards the camera. */
  var glowR, glowG, glowB = 0f

  def start(hero: Int): Unit =
    weights.start(hero, 0f)
    glowR = 0f
    glowG = 0f
    glowB = 0f
