package candela.scenefile

import candela.base.{Problem, SceneError, SourcePos}

/** The graphics state and the blocks that saved earlier ones.
  *
  * @param whole does `TransformEnd` bring back everything, as in v4, or the transforms only?
  */
final class Blocks(whole: () => Boolean):
  private var open = List.empty[OpenBlock]

  /** What holds now. */
  var state = GraphicsState()

  /** Has a statement been skipped, so that blocks may be unbalanced for that reason alone? */
  var isDoubtful = false

  def begin(directive: String, at: SourcePos): Unit =
    open = OpenBlock(directive, at, state) :: open

  /** Closes the innermost block, which must be a `begin`. */
  def end(begin: String, at: SourcePos): Unit =
    open match
      case block :: rest if block.begin == begin =>
        close(block)
        open = rest
      case _ => recover(begin, at)

  /** Closes what can be closed, and complains. */
  private def recover(begin: String, at: SourcePos): Unit =
    val name = begin.replace("Begin", "End")
    val (inner, rest) = open.span(_.begin != begin)
    rest.headOption.foreach: block =>
      close(block)
      open = rest.tail
    if !isDoubtful then
      val problem = (inner, rest) match
        case (block :: _, _ :: _) =>
          val message = s"$name, but the ${block.begin} at ${block.at} is still open"
          Problem.error(at, message, Some(s"write ${block.end} first"))
        case _ => Problem.error(at, s"$name without $begin")
      throw SceneError(problem)

  private def close(block: OpenBlock): Unit =
    val transforms = state.withTransformsOf(block.saved)
    val isMore = block.begin != "TransformBegin" || transforms == block.saved || whole()
    state = if isMore then block.saved else transforms

  /** Problems of all blocks that were never closed. */
  def unclosed: Vector[Problem] =
    if isDoubtful then Vector.empty
    else
      open.reverse.toVector.map: block =>
        val help = Some(s"write ${block.end} after it")
        Problem.error(block.at, s"${block.begin} is never closed", help)

  /** Runs `body` with blocks of its own on top of the present state, and then forgets what it
    * changed.
    */
  def isolated(body: => Unit): Vector[Problem] =
    val (savedOpen, savedState) = (open, state)
    open = Nil
    try
      body
      unclosed
    finally
      open = savedOpen
      state = savedState
