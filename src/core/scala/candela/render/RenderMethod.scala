package candela.render

import candela.bidirectional.ChainPaths
import candela.film.{Splats, View}
import candela.guiding.{Guide, GuideSettings}
import candela.integrators.{Integrator, SharedChains, SharedPasses}

/** Organisation of an image's samples, selected by the integrator's recipe. Parts that depend on
  * the camera or film are created once these are known.
  */
enum RenderMethod:

  /** Independent camera samples, tile by tile. */
  case Tiles(integrator: Integrator)

  /** Camera samples, tile by tile, whose paths learn from those of earlier passes.
    *
    * @param unguided   their integrator, if nothing is learnt
    * @param settings   of what is learnt
    * @param integrator learns, and is guided
    */
  case Guided(unguided: Integrator, settings: GuideSettings, integrator: Guide => Integrator)

  /** Camera samples, tile by tile; their light paths splat to the whole film. */
  case SplattedTiles(integrator: View => Integrator)

  /** Camera samples, tile by tile; samples of equal number share their pass's precomputation. */
  case Passes(passes: View => SharedPasses)

  /** Markov chains, which choose film positions themselves.
    *
    * @param paths      the paths that they explore, with their splats
    * @param chains     the chains of such paths
    * @param integrator evaluates a single camera sample without chains
    */
  case Chains(
      paths: (View, Splats) => ChainPaths,
      chains: (View, Splats => ChainPaths) => SharedChains,
      integrator: View => Integrator
  )

  /** Whether the sampler places the camera samples; required for AOVs. */
  def takesCameraSamples: Boolean = this match
    case Chains(_, _, _) => false
    case _ => true

  /** Whether samples may contribute to all pixels within the filter's radius. Light paths and
    * photons contribute to the pixel that they were started for.
    */
  def canShareSamples: Boolean = this match
    case Tiles(_) | Guided(_, _, _) => true
    case _ => false

  /** Whether samples depend on those before. */
  def learns: Boolean = this match
    case Guided(_, _, _) => true
    case _ => false

  /** Whether samples can be added beyond the planned number. */
  def canKeepOn: Boolean = this match
    case Tiles(_) | SplattedTiles(_) => true
    case _ => false

  /** Whether all light comes with the wavelengths of its camera sample, not by splats. */
  def hasWavelengths: Boolean = this match
    case Tiles(_) | Guided(_, _, _) | Passes(_) => true
    case _ => false

  /** Whether its light is divided by way and source, as the scene asks. */
  def dividesLight: Boolean = this match
    case Tiles(integrator) => integrator.lightParts != null
    case Guided(unguided, _, _) => unguided.lightParts != null
    case _ => false

  /** Whether light paths connect to the camera. */
  def seesLightPaths: Boolean = this match
    case SplattedTiles(_) | Chains(_, _, _) => true
    case _ => false
