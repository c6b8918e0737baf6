package candela.bsdf

import candela.color.Rgb

/** How light that enters a surface at one place leaves it at another: it depends on their distance,
  * and on the direction at either. Immutable.
  */
abstract class Bssrdf:

  /** The factor of light that went this far, for each unit of area; without what the surface does
    * at either end.
    */
  def apply(distance: Float): Rgb

  /** Draws the distance from an axis: of a channel that is drawn at random, a place in the plane
    * around the axis has the density [[density]].
    *
    * @return below 0 if no light of this channel comes out
    */
  def sample(channel: Int, u: Float): Float

  /** For each unit of area. */
  def density(radius: Float): Float

  /** What [[sample]] returns is taken no farther than this: almost all is within. */
  def reach(channel: Int): Float

  /** How the light gets in, seen from the medium: from all directions to straight up. */
  def entry: Bsdf

/** A [[Bssrdf]] by profiles.
  *
  * @param profiles   of each channel
  * @param extinction coefficient, whose inverse is the unit of length of each profile
  * @param eta        index of refraction of the medium over that outside; what leaves has been
  *                   refracted by [[Dielectric]], which spreads radiance by its square
  */
final class TabulatedBssrdf(
    profiles: Array[RadialProfile],
    extinction: Rgb,
    eta: Float,
    val entry: Bsdf
) extends Bssrdf:
  private val perLength = Array(extinction.r, extinction.g, extinction.b)
  private val reaches =
    Array.tabulate(3)(c => length(c, profiles(c).sample(TabulatedBssrdf.Reached)))

  def apply(distance: Float): Rgb =
    Rgb(factor(0, distance), factor(1, distance), factor(2, distance)) * (eta * eta)

  private def factor(channel: Int, distance: Float): Float =
    val s = perLength(channel)
    if isClear(s) then 0f else profiles(channel)(distance * s) * s * s

  def density(radius: Float): Float =
    var sum = 0f
    var c = 0
    while c < 3 do
      val s = perLength(c)
      if !isClear(s) then sum += profiles(c).density(radius * s) * s * s
      c += 1
    sum * (1f / 3f)

  def sample(channel: Int, u: Float): Float = length(channel, profiles(channel).sample(u))

  def reach(channel: Int): Float = reaches(channel)

  private def length(channel: Int, freePaths: Float): Float =
    if isClear(perLength(channel)) then -1f else freePaths / perLength(channel)

  /** Nothing comes back from a medium that doesn't scatter, or from one without depth. */
  private def isClear(extinction: Float): Boolean =
    !(extinction > 0f) || extinction == Float.PositiveInfinity

object TabulatedBssrdf:
  /** A thousandth is left out, and more where other channels reach farther around a body: so in
    * PBRT 3rd ed., §15.4.1, and in pbrt.
    */
  private inline val Reached = 0.999f
