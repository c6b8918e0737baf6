package candela.bsdf

import candela.color.Rgb

/** A separable BSSRDF: light enters at one point and exits at another, with a factor for their
  * distance and one for the direction at each. Immutable.
  */
abstract class Bssrdf:

  /** The radial profile at `distance`, per unit area, without the surface terms at entry and exit.
    */
  def apply(distance: Float): Rgb

  /** Samples the distance from the probe axis. With a uniformly chosen channel, points in the plane
    * around the axis have the pdf [[density]].
    *
    * @return below 0 if no light of this channel exits
    */
  def sample(channel: Int, u: Float): Float

  /** The pdf of [[sample]] with respect to area, averaged over the channels. */
  def density(radius: Float): Float

  /** Truncation radius of [[sample]]; contains almost all of the profile. */
  def reach(channel: Int): Float

  /** Fresnel transmittance on exit at this angle, for light that no BSDF refracts. */
  def leaving(cosine: Float): Float = 1f - Fresnel.dielectric(Math.abs(cosine), eta)

  /** Index of refraction inside over that outside. */
  def eta: Float

  /** BSDF of the entering light, seen from inside the medium. */
  def entry: Bsdf
