package candela.bidirectional

import candela.film.{Splats, View}
import candela.integrators.{ChainWalker, SharedChains}
import candela.sampling.SampleHash

/** How chains walk.
  *
  * @param bootstrap least number of paths of [[Bootstrap]]
  * @param chains    that walk independently
  * @param largeStep probability of a path that is all new
  * @param sigma     standard deviation of each random number in the other steps
  */
final case class MetropolisSettings(
    bootstrap: Int,
    chains: Int,
    largeStep: Float,
    sigma: Float,
    seed: Int = 0
)

/** Metropolis light transport in the space of random numbers: chains of paths, each a small change
  * of the last or all new, that come to each path as often as it is bright. The paths are those of
  * [[BidirectionalPathTracer]], which makes one picture of one sequence of random numbers; so where
  * light is hard to find, what has been found is explored.
  *
  * The chains start at paths of [[Bootstrap]], chosen by their brightness, so that no chain has to
  * find its way to the light first.
  *
  * Sources: Veach and Guibas, "Metropolis Light Transport", SIGGRAPH 1997; Kelemen et al., see
  * [[PrimarySamples]]; PBRT 3rd ed., §16.4.
  *
  * @param tracer finds paths, and hands what they bring to the given splats
  */
final class MarkovChains(
    tracer: Splats => BidirectionalPathTracer,
    settings: MetropolisSettings,
    view: View
) extends SharedChains:
  import MarkovChains.*

  val count: Int = Math.max(1, Math.min(settings.chains, view.pixels.toInt))
  private val states = new Array[MarkovChain](count)
  private val bootstrap =
    Bootstrap(settings.bootstrap, view.crop.pixels * view.samplesPerPixel)

  def walker(): ChainWalker = MarkovWalker(tracer, settings, view, this)

  /** Helps to find where chains start, until that is known. */
  private[bidirectional] def begin(walker: MarkovWalker, isStopped: () => Boolean): Unit =
    if bootstrap.start.isEmpty then
      val samples = PrimarySamples(settings.largeStep, settings.sigma)
      bootstrap.help(isStopped): path =>
        samples.start(seed(path, Independent))
        walker.follow(samples)
        walker.proposed.strength

  /** Where chains start; none before [[begin]] has found it. */
  private[bidirectional] def start: Option[Bootstrap.Start] = bootstrap.start

  /** The chain of this number, begun if it was not. */
  private[bidirectional] def apply(
      chain: Int,
      start: Bootstrap.Start,
      walker: MarkovWalker
  ): MarkovChain =
    if states(chain) == null then
      val state = MarkovChain(PrimarySamples(settings.largeStep, settings.sigma), view)
      val jitter = SampleHash.toUnit(SampleHash.mix64(seed(chain, Starts)).toInt)
      state.samples.start(seed(start.path((chain + jitter) / count), Independent))
      walker.follow(state.samples)
      state.current.exchange(walker.proposed)
      state.samples.branch(seed(chain, Walks))
      states(chain) = state
    states(chain)

  private def seed(number: Int, purpose: Int): Long =
    SampleHash.pixel(number, purpose, settings.seed)

object MarkovChains:
  /** Purposes of seeds. */
  private inline val Independent = 0
  private inline val Starts = 1
  private inline val Walks = 2

/** Where a chain is. */
private[bidirectional] final class MarkovChain(val samples: PrimarySamples, view: View):
  val current: Contribution = Contribution(view)
