package candela.media

import candela.color.Rgb
import candela.geometry.Ray
import candela.sampling.PhaseFunction

/** A participating medium, which scatters, absorbs or emits light between surfaces. Immutable.
  *
  * Scattering is sampled, absorption is a weight: a purely absorbing medium adds no noise where its
  * transmittance is known analytically, and little where it is estimated.
  */
abstract class Medium:
  val phase: PhaseFunction

  /** Traces the camera path along `ray`, up to `ray.tMax`, to the next scattering event. Multiplies
    * `work.weights` by the path's weight, and adds the emission on the way to `work`'s glow.
    *
    * @param first number in [0, 1) from the path's sampler, for the first collision
    * @param emits whether to add the medium's emission
    * @return the ray's parameter at the scattering event; −1 if there is none
    */
  def follow(ray: Ray, first: Float, emits: Boolean, work: MediumWork): Float

  /** Multiplies `work.shadow` by the transmittance along `ray`, up to `ray.tMax`. */
  def attenuate(ray: Ray, work: MediumWork): Unit

  /** Whether the coefficients depend on colour. */
  def isChromatic: Boolean

  def isEmissive: Boolean

  /** Summary for the render plan. */
  def describe: String

object Medium:
  private val MaxKinds = 8

  /** `3 (2 homogeneous; cloud)`: how many there are of each description, of many the first ones. */
  private[media] def summary(descriptions: Seq[String]): String =
    val kinds = descriptions.distinct
    val count = descriptions.groupMapReduce(identity)(_ => 1)(_ + _)
    val listed = kinds.take(MaxKinds).map(k => if count(k) == 1 then k else s"${count(k)} $k")
    val omitted = Option.when(kinds.size > MaxKinds)(s"${kinds.size - MaxKinds} more kinds")
    s"${descriptions.size} (${(listed ++ omitted).mkString("; ")})"

  /** Whether these coefficients depend on colour. */
  private[media] def isChromatic(absorption: Rgb, scattering: Rgb): Boolean =
    Seq(absorption + scattering, scattering).exists(c => c.r != c.g || c.g != c.b)

/** Coefficients at a point, per scene unit; mutable. Emission is local, per length: the absorption
  * coefficient times the radiance of an opaque medium.
  */
final class MediumPoint:
  var absorbR, absorbG, absorbB = 0f
  var scatterR, scatterG, scatterB = 0f
  var glowR, glowG, glowB = 0f

  /** Sets the coefficients to `density` times the given ones; leaves `glow` unchanged. */
  def setDensity(density: Float, absorption: Rgb, scattering: Rgb): Unit =
    absorbR = density * absorption.r
    absorbG = density * absorption.g
    absorbB = density * absorption.b
    scatterR = density * scattering.r
    scatterG = density * scattering.g
    scatterB = density * scattering.b

  /** Makes emission local: from the radiance of an opaque medium to that per length. */
  def absorbGlow(): Unit =
    glowR *= absorbR
    glowG *= absorbG
    glowB *= absorbB
