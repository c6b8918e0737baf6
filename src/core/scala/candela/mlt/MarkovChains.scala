package candela.mlt

import candela.bdpt.ChainPaths
import candela.io.{CheckedInput, CheckedOutput}
import candela.film.{Splats, View}
import candela.integrators.{ChainWalker, SharedChains}
import candela.sampling.SampleHash

/** Settings of Metropolis light transport.
  *
  * @param bootstrap minimum number of paths of [[Bootstrap]]
  * @param chains    number of independent chains
  * @param largeStep probability of a large step (an independent path)
  * @param sigma     standard deviation of each random number in small steps
  */
final case class MetropolisSettings(
    bootstrap: Int,
    chains: Int,
    largeStep: Float,
    sigma: Float,
    seed: Int = 0
)

/** Primary sample space Metropolis light transport: Markov chains of small and large steps that
  * visit paths in proportion to their brightness. The paths are those of
  * [[BidirectionalPathTracer]], a deterministic function of its random numbers, so that chains
  * explore the neighbourhood of light paths that are hard to find.
  *
  * Chains start at [[Bootstrap]] paths, sampled by brightness, which avoids start-up bias.
  *
  * Sources: Veach and Guibas, "Metropolis Light Transport", SIGGRAPH 1997; Kelemen et al., see
  * [[PrimarySamples]]; PBRT 3rd ed., §16.4.
  *
  * @param tracer creates the path tracer, given the receiver of its splats
  */
final class MarkovChains(
    tracer: Splats => ChainPaths,
    settings: MetropolisSettings,
    view: View
) extends SharedChains:
  import MarkovChains.*

  val count: Int = Math.max(1, Math.min(settings.chains, view.pixels.toInt))
  private val states = new Array[MarkovChain | Null](count)
  private val bootstrap =
    Bootstrap(settings.bootstrap, view.crop.pixels * view.samplesPerPixel)

  def walker(): ChainWalker = MarkovWalker(tracer, settings, view, this)

  /** Helps with the bootstrap until it is complete. */
  private[candela] def prepare(walker: MarkovWalker, isStopped: () => Boolean): Unit =
    if bootstrap.start.isEmpty then
      val samples = PrimarySamples(settings.largeStep, settings.sigma)
      bootstrap.help(isStopped): path =>
        samples.start(seed(path, Independent))
        walker.follow(samples)
        walker.proposed.strength

  /** Initial states of the chains; none before [[prepare]] has computed them. */
  private[candela] def start: Option[Bootstrap.Start] = bootstrap.start

  /** The chain `chain`, created on first use. */
  private[candela] def apply(
      chain: Int,
      start: Bootstrap.Start,
      walker: MarkovWalker
  ): MarkovChain =
    if states(chain) == null then
      val state = MarkovChain(PrimarySamples(settings.largeStep, settings.sigma), view)
      val jitter = SampleHash.toUnit(SampleHash.mix64(seed(chain, Starts)).toInt)
      state.samples.start(seed(start.path((chain + jitter) / count), Independent))
      walker.follow(state.samples)
      state.current.swap(walker.proposed)
      state.samples.branch(seed(chain, Walks))
      states(chain) = state
    states(chain)

  /** The bootstrap is not saved: it is computed again. */
  def save(to: CheckedOutput): Unit =
    val begun = states.indices.filter(states(_) != null)
    to.int(begun.size)
    for i <- begun do
      to.int(i)
      states(i).samples.save(to)
      states(i).current.save(to)

  def load(from: CheckedInput): Unit =
    for _ <- 0 until from.count(bytes = 4) do
      val state = MarkovChain(PrimarySamples(settings.largeStep, settings.sigma), view)
      states(from.int()) = state
      state.samples.load(from)
      state.current.load(from)

  def settle(chain: Int, weight: Float): Unit =
    // Forged films may speak of a chain that has not begun
    for state <- Option(states(chain)) do state.current.addTo(view.splats, weight)

  private def seed(number: Int, purpose: Int): Long =
    SampleHash.pixel(number, purpose, settings.seed)

object MarkovChains:
  /** Purposes of seeds. */
  private inline val Independent = 0
  private inline val Starts = 1
  private inline val Walks = 2

/** State of a chain. */
private[candela] final class MarkovChain(val samples: PrimarySamples, view: View):
  val current: Contribution = Contribution(view)
