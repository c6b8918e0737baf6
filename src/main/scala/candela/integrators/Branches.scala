package candela.integrators

import scala.collection.mutable.ArrayBuffer

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
