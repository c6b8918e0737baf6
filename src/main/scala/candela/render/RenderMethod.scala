package candela.render

import candela.film.View
import candela.integrators.{Integrator, SharedChains, SharedPasses}

/** Organisation of an image's samples, selected by the integrator's recipe. Parts that depend on
  * the camera or film are created once these are known.
  */
enum RenderMethod:

  /** Independent camera samples, tile by tile. */
  case Tiles(integrator: Integrator)

  /** Camera samples, tile by tile; their light paths splat to the whole film. */
  case SplattedTiles(integrator: View => Integrator)

  /** Camera samples, tile by tile; samples of equal number share their pass's precomputation. */
  case Passes(passes: View => SharedPasses)

  /** Markov chains, which choose film positions themselves.
    *
    * @param integrator evaluates a single camera sample without chains
    */
  case Chains(chains: View => SharedChains, integrator: View => Integrator)

  /** Whether the sampler places the camera samples; required for AOVs. */
  def takesCameraSamples: Boolean = this match
    case Chains(_, _) => false
    case _ => true

  /** Whether samples may contribute to all pixels within the filter's radius. Light paths and
    * photons contribute to the pixel that they were started for.
    */
  def canShareSamples: Boolean = this match
    case Tiles(_) => true
    case _ => false

  /** Whether samples can be added beyond the planned number. */
  def canKeepOn: Boolean = this match
    case Tiles(_) | SplattedTiles(_) => true
    case _ => false

  /** Whether light paths connect to the camera. */
  def seesLightPaths: Boolean = this match
    case SplattedTiles(_) | Chains(_, _) => true
    case _ => false

  def splitsLight: Boolean = this match
    case Tiles(integrator) => integrator.splitsLight
    case _ => false
