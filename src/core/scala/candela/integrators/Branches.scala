package candela.integrators

import candela.base.loop
import candela.sampling.Sampler

import scala.collection.mutable.ArrayBuffer

/** A walk whose paths leave vertices in several branches, as [[Guidance]] asks for. Branches are
  * followed one after the other.
  *
  * @tparam S what the walk keeps of itself
  */
private[integrators] trait BranchingWalk[S]:
  protected def guidance: Guidance
  protected def branches: Branches[S]

  /** Light found so far, in all branches: the average of the colours. */
  protected def found: Float

  protected def keep(to: S): Unit
  protected def goOn(from: S): Unit
  protected def scatterOnce(branch: Int): Unit

  /** Leaves in the direction that [[scatterOnce]] has sampled, or ends. */
  protected def leaveInBranch(): Unit
  def goesOn: Boolean

  /** Leaves the vertex in all branches, which wait then. */
  protected final def leaveInBranches(): Unit =
    keepIn(branches.origin)
    loop(guidance.branches): i =>
      follow(branches.origin)
      scatterOnce(i)
      leaveInBranch()
      if goesOn then
        val branch = branches.push()
        keepIn(branch)
        guidance.keepPosition(i, branch.mark)

  private def keepIn(branch: Branches.Branch[S]): Unit =
    keep(branch.state)
    guidance.keep(branch.mark)

  private def follow(branch: Branches.Branch[S]): Unit =
    goOn(branch.state)
    guidance.follow(branch.mark, found)

  /** Goes on with a branch that waits; false: none. */
  final def followNext(sampler: Sampler): Boolean =
    val waits = !branches.isEmpty
    if waits then
      val branch = branches.pop()
      follow(branch)
      sampler.goTo(branch.mark.position)
    waits

  /** All light of the path is found. */
  final def finish(): Unit = guidance.finish(found)

/** Branches of a guided path that wait to be followed. Their memory is used again. Mutable, one per
  * worker.
  *
  * @tparam S what the walk keeps of itself
  */
private[integrators] final class Branches[S](newState: () => S):
  import Branches.Branch
  private val all = ArrayBuffer.empty[Branch[S]]
  private var count = 0

  /** The path as it came to the vertex from which branches leave. */
  val origin: Branch[S] = Branch(newState())

  /** A place for another. */
  def push(): Branch[S] =
    if count == all.length then all += Branch(newState())
    count += 1
    all(count - 1)

  def isEmpty: Boolean = count == 0

  /** The last one, which waits no longer. */
  def pop(): Branch[S] =
    count -= 1
    all(count)

private[integrators] object Branches:
  final class Branch[S](val state: S):
    val mark: Guidance.Mark = Guidance.Mark()
