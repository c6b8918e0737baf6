package candela.integrators

/** The Markov chains of one rendering, shared by all workers. What they find goes to the film's
  * [[candela.film.Splats]] alone.
  */
abstract class SharedChains:
  def count: Int

  /** Work space of one worker. */
  def walker(): ChainWalker

/** Takes chains on; mutable, one per worker. A chain may be handed from one to another, but not be
  * walked by two at a time.
  */
abstract class ChainWalker:
  /** Makes ready what all chains need, with the other workers; false if it was told to stop on the
    * way. Chains are advanced only after it.
    */
  def begin(isStopped: () => Boolean): Boolean

  /** Takes a chain on by so many paths. */
  def advance(chain: Int, paths: Long): Unit

  /** Where on the film, in pixels, the path is that was tried last. */
  def x: Int
  def y: Int

  /** Paths that were no light (NaN or infinite), and so were left out. */
  def refused: Long
  def raysTraced: Long
  def lastMaterial: Int
