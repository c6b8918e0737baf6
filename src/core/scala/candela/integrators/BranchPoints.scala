package candela.integrators

import candela.math.belowOne
import candela.sampling.{SampleHash, Sampler}

/** The random numbers with which a guided path leaves a vertex. Each branch is a strip of the unit
  * square, as wide as all others: evenly spread points give evenly spread directions of all
  * branches together. The last strip may be narrower, so that there can be 0.7 or 2.3 branches on
  * average. Mutable, one per worker.
  */
private[integrators] final class BranchPoints:
  import BranchPoints.*
  private val choices, xs, ys = new Array[Float](MaxBranches)
  private val positions = new Array[Long](MaxBranches)
  private var strips = 1f

  /** Branches of this time. */
  var count: Int = 0

  /** Draws the points. The sampler goes on behind the first, however many there are.
    *
    * @param average number of branches, above 0, at most [[BranchPoints.MaxBranches]]
    * @param chooses does what is sampled discretely matter?
    */
  def draw(average: Float, chooses: Boolean, sampler: Sampler): Unit =
    strips = average
    count = Math.ceil(average).toInt
    drawPoint(0, chooses, sampler)
    if count > 1 then
      var branch = 1
      while branch < count do
        sampler.skipTo(beginning(branch))
        drawPoint(branch, chooses, sampler)
        branch += 1
      sampler.goTo(positions(0))
    // Beyond the end of the last strip
    if count - 1 + xs(count - 1) >= average then count -= 1

  private def drawPoint(branch: Int, chooses: Boolean, sampler: Sampler): Unit =
    choices(branch) = sampler.next1D(matters = chooses)
    sampler.next2D()
    xs(branch) = sampler.x
    ys(branch) = sampler.y
    positions(branch) = sampler.position

  /** The first request of a further branch: the same in all samples of a pixel, and far from those
    * of the path's others.
    */
  private def beginning(branch: Int): Int =
    (SampleHash.mix64(positions(0) + branch) >>> 33).toInt | Far

  /** For what is sampled discretely. */
  def choice(branch: Int): Float = choices(branch)

  /** The point of the unit square. */
  def x(branch: Int): Float = belowOne((branch + xs(branch)) / strips)
  def y(branch: Int): Float = ys(branch)

  /** Where the sampler goes on ([[Sampler.goTo]]). */
  def position(branch: Int): Long = positions(branch)

private[integrators] object BranchPoints:
  /** Branches of a vertex, at most. */
  inline val MaxBranches = 8

  /** A request that paths without branches don't reach. */
  private inline val Far = 1 << 16
