package candela.integrators

import scala.collection.mutable.ArrayBuffer

/** Branches of a guided path that wait to be followed. Their memory is used again. Mutable, one per
  * worker.
  */
private[integrators] final class Branches(newPath: () => PathState):
  import Branches.Branch
  private val branches = ArrayBuffer.empty[Branch]
  private var count = 0

  /** The path as it came to the vertex from which branches leave. */
  val origin: Branch = Branch(newPath())

  /** A place for another. */
  def push(): Branch =
    if count == branches.length then branches += Branch(newPath())
    count += 1
    branches(count - 1)

  def isEmpty: Boolean = count == 0

  /** The last one, which waits no longer. */
  def pop(): Branch =
    count -= 1
    branches(count)

private[integrators] object Branches:
  final class Branch(val path: PathState):
    val history: PathHistory = PathHistory(path)
    val departure: Departure = Departure()
    val state: Guidance.BranchState = Guidance.BranchState()
