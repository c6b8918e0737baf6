package candela.sampling

/** Picks one of n things with given weights; all-zero weights count as equal ones. Immutable.
  *
  * The pick grows with the random number, so that a well-distributed sequence of numbers makes a
  * well-distributed sequence of picks (an alias table would shuffle them).
  */
final class Discrete(weights: Array[Float]):
  require(weights.length > 0, "nothing to pick from")

  private val cdf = new Array[Float](weights.length + 1)

  /** The sum of the weights. */
  val total: Double = Cdf.write(weights, 0, weights.length, cdf, 0)

  def size: Int = cdf.length - 1

  /** The pick for `u` in [0, 1); never one of probability 0. */
  def sample(u: Float): Int = Cdf.find(cdf, 0, size, u)

  /** What is left of `u` after it picked `picked`: uniform in [0, 1) again, with fewer bits. */
  def remapped(u: Float, picked: Int): Float = Cdf.within(cdf, 0, picked, u)

  /** With which probability `sample` picks `index`. */
  def probability(index: Int): Float = cdf(index + 1) - cdf(index)
