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
