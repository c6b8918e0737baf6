package candela.integrators

import candela.base.loop
import candela.sampling.Sampler

import scala.collection.mutable.ArrayBuffer

/** Branches of a guided path that wait to be followed. Their memory is used again. Mutable, one per
  * worker.
  *
  * @tparam S what the walk keeps of itself
  */
private[integrators] final class Branches[S](guidance: Guidance, newState: () => S):
  import Branches.Branch
  private val all = ArrayBuffer.empty[Branch[S]]
  private var count = 0

  /** The path as it came to the vertex from which branches leave. */
  val origin: Branch[S] = Branch(newState())

  /** Leaves the vertex in all branches, which wait then.
    *
    * @param keep   keeps what the walk has of itself
    * @param follow goes on where a branch began
    * @param leave  leaves in the branch of this number; false if it ends there
    */
  inline def divide(
      inline keep: S => Unit,
      inline follow: Branch[S] => Unit,
      inline leave: Int => Boolean
  ): Unit =
    keep(origin.state)
    guidance.keep(origin.mark)
    loop(guidance.branches): i =>
      follow(origin)
      if leave(i) then
        val branch = push()
        keep(branch.state)
        guidance.keep(branch.mark)
        guidance.keepPosition(i, branch.mark)

  /** Goes on with a branch that waits; false: none. */
  inline def followNext(sampler: Sampler, inline follow: Branch[S] => Unit): Boolean =
    val waits = !isEmpty
    if waits then
      val branch = pop()
      follow(branch)
      sampler.goTo(branch.mark.position)
    waits

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
