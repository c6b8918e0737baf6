package candela.bidirectional

import candela.integrators.{ChainWalker, Chains, View}
import candela.sampling.{Discrete, SampleHash}

import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.locks.LockSupport

/** The chains of one rendering, and where they start: at paths thrown independently, chosen by
  * their brightness, so that no chain has to find its way to the light first. Who needs the start
  * helps to find it; what comes out does not depend on who did.
  */
private[bidirectional] final class MarkovChains(
    paths: BidirectionalPathTracer,
    settings: MetropolisSettings,
    view: View
) extends Chains:
  import MarkovChains.*

  val count: Int = Math.max(1, Math.min(settings.chains, view.pixels.toInt))
  private val states = new Array[MarkovChain](count)
  private val strengths = new Array[Float](Math.max(1, settings.bootstrap))
  private val parts = (strengths.length + PartSize - 1) / PartSize
  private val next = AtomicInteger()
  private val done = AtomicInteger()
  @volatile private var failure: Option[Throwable] = None
  @volatile private var start: Option[Discrete] = None

  def walker(): ChainWalker = MarkovWalker(paths.another(), settings, view, this)

  /** The mean brightness of all paths; 0 if none has brought light. */
  def mean: Float =
    start.fold(0f)(found => (found.total / strengths.length).toFloat)

  /** The chain of this number, begun if it was not. Only once `help` has returned. */
  def apply(chain: Int, walker: MarkovWalker): MarkovChain =
    if states(chain) == null then
      val state = MarkovChain(PrimarySamples(settings.largeStep, settings.sigma), view)
      val jitter = SampleHash.toUnit(SampleHash.mix64(seed(chain, Starts)).toInt)
      for found <- start do
        state.samples.start(seed(found.sample((chain + jitter) / count), Bootstrap))
        walker.follow(state.samples, state.current)
        state.samples.branch(seed(chain, Walks))
      states(chain) = state
    states(chain)

  /** Returns when it is known where chains start. */
  def help(walker: MarkovWalker): Unit =
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
    val found = Contribution(view)
    var part = next.getAndIncrement()
    while part < parts do
      val end = Math.min(strengths.length, (part + 1) * PartSize)
      var i = part * PartSize
      while i < end do
        samples.start(seed(i, Bootstrap))
        walker.follow(samples, found)
        strengths(i) = found.strength
        i += 1
      if done.incrementAndGet() == parts then start = Some(Discrete(strengths))
      part = next.getAndIncrement()

  private def seed(number: Int, purpose: Int): Long =
    SampleHash.pixel(number, purpose, settings.seed)

private object MarkovChains:
  /** Purposes of seeds. */
  inline val Bootstrap = 0
  inline val Starts = 1
  inline val Walks = 2

  val PartSize = 256

  /** Nanoseconds; short beside a bootstrap. */
  val Pause = 50_000L

/** Where a chain is. */
private[bidirectional] final class MarkovChain(val samples: PrimarySamples, view: View):
  var current: Contribution = Contribution(view)
