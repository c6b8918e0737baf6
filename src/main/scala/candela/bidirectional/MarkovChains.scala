package candela.bidirectional

import candela.film.{Splats, View}
import candela.integrators.{ChainWalker, SharedChains}
import candela.sampling.{Discrete, SampleHash}

import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.locks.LockSupport

/** How chains walk.
  *
  * @param bootstrap paths from which the mean brightness is known and the chains start
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
  * The chains start at paths thrown independently, chosen by their brightness, so that no chain has
  * to find its way to the light first. Who needs the start helps to find it; what comes out does
  * not depend on who did.
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
  private val strengths = new Array[Float](Math.max(1, settings.bootstrap))
  private val parts = (strengths.length + PartSize - 1) / PartSize
  private val next = AtomicInteger()
  private val done = AtomicInteger()
  @volatile private var failure: Option[Throwable] = None
  @volatile private var start: Option[Discrete] = None

  def walker(): ChainWalker = MarkovWalker(tracer, settings, view, this)

  /** The mean brightness of all paths; 0 if none has brought light. */
  private[bidirectional] def mean: Float =
    start.fold(0f)(found => (found.total / strengths.length).toFloat)

  /** The chain of this number, begun if it was not. Only once `help` has returned. */
  private[bidirectional] def apply(chain: Int, walker: MarkovWalker): MarkovChain =
    if states(chain) == null then
      val state = MarkovChain(PrimarySamples(settings.largeStep, settings.sigma), view)
      val jitter = SampleHash.toUnit(SampleHash.mix64(seed(chain, Starts)).toInt)
      for found <- start do
        state.samples.start(seed(found.sample((chain + jitter) / count), Bootstrap))
        walker.follow(state.samples)
        state.current.exchange(walker.proposed)
        state.samples.branch(seed(chain, Walks))
      states(chain) = state
    states(chain)

  /** Returns when it is known where chains start. */
  private[bidirectional] def help(walker: MarkovWalker): Unit =
    if start.isEmpty then
      try work(walker)
      catch
        case e: Throwable =>
          failure = Some(e)
          throw e
      while start.isEmpty do
        for e <- failure do throw e
        LockSupport.parkNanos(Pause)

  private def work(walker: MarkovWalker): Unit =
    val samples = PrimarySamples(settings.largeStep, settings.sigma)
    var part = next.getAndIncrement()
    while part < parts do
      val end = Math.min(strengths.length, (part + 1) * PartSize)
      var i = part * PartSize
      while i < end do
        samples.start(seed(i, Bootstrap))
        walker.follow(samples)
        strengths(i) = walker.proposed.strength
        i += 1
      if done.incrementAndGet() == parts then start = Some(Discrete(strengths))
      part = next.getAndIncrement()

  private def seed(number: Int, purpose: Int): Long =
    SampleHash.pixel(number, purpose, settings.seed)

object MarkovChains:
  /** Purposes of seeds. */
  private inline val Bootstrap = 0
  private inline val Starts = 1
  private inline val Walks = 2

  private val PartSize = 256

  /** Nanoseconds; short beside a bootstrap. */
  private val Pause = 50_000L

/** Where a chain is. */
private[bidirectional] final class MarkovChain(val samples: PrimarySamples, view: View):
  val current: Contribution = Contribution(view)
