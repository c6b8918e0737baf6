package candela.render

import candela.film.View
import candela.integrators.{Integrator, SharedChains, SharedPasses}

/** How the samples of an image are organised; the integrator's recipe chooses it. What depends on
  * the camera or the film is made when they are known.
  */
enum RenderMethod:

  /** Camera samples, tile by tile, each independent of all others. */
  case Tiles(integrator: Integrator)

  /** Camera samples, tile by tile, whose light paths splat to all of the film. */
  case SplattedTiles(integrator: View => Integrator)

  /** Camera samples, tile by tile; all of one number share what their pass has prepared. */
  case Passes(passes: View => SharedPasses)

  /** Markov chains, which choose places on the film themselves.
    *
    * @param integrator takes a camera sample by itself, as if there were no chains
    */
  case Chains(chains: View => SharedChains, integrator: View => Integrator)

  /** Does it take camera samples where the sampler says? Else there are no layers, either. */
  def takesCameraSamples: Boolean = this match
    case Chains(_, _) => false
    case _ => true

  /** May samples count in all pixels that the filter reaches? What light paths and photons find
    * belongs to the pixel that it was begun for.
    */
  def canShareSamples: Boolean = this match
    case Tiles(_) => true
    case _ => false

  /** Do paths from the lights end at the camera? */
  def seesLightPaths: Boolean = this match
    case SplattedTiles(_) | Chains(_, _) => true
    case _ => false

  def splitsLight: Boolean = this match
    case Tiles(integrator) => integrator.splitsLight
    case _ => false
