package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, SourcePos}

/** The graphics state and its stack of open blocks.
  *
  * @param isV4 whether the scene is v4, in which `TransformEnd` restores the whole state, not only
  *   the transforms, and unbalanced blocks are errors
  * @param warn receives warnings about unbalanced blocks in v2 and v3
  */
final class Blocks(isV4: () => Boolean, warn: Problem => Unit):
  private var openBlocks = List.empty[OpenBlock]

  /** The current graphics state. */
  var state = GraphicsState()

  /** Whether a statement was skipped, which may itself unbalance the blocks. */
  var isDoubtful = false

  def start(directive: String, at: SourcePos): Unit =
    openBlocks = OpenBlock(directive, at, state) :: openBlocks

  /** Closes the innermost block, which should be a `begin`. */
  def end(begin: String, at: SourcePos): Unit =
    openBlocks match
      case block :: outer if block.begin == begin =>
        close(block)
        openBlocks = outer
      case _ => recover(begin, at)

  /** Closes what it can, and reports the mismatch: an error in v4, a warning in v2 and v3. */
  private def recover(begin: String, at: SourcePos): Unit =
    val name = begin.replace("Begin", "End")
    val isOld = !isV4()
    // In v2 and v3 objects are attribute blocks: either end closes the innermost of both.
    val ends =
      if isOld && begin != "TransformBegin" then Set("AttributeBegin", "ObjectBegin")
      else Set(begin)
    val (inner, outer) = openBlocks.span(b => !ends(b.begin))
    outer.headOption.foreach: block =>
      close(block)
      openBlocks = outer.tail
    if !isDoubtful then
      val crossed = inner.headOption.orElse(outer.headOption).filter(_ => outer.nonEmpty)
      val message = crossed match
        case Some(block) => s"$name, but the ${block.begin} at ${block.pos} is still open"
        case None => s"$name without $begin"
      val help = crossed.map(block => s"write ${block.end} first")
      if !isOld then throw SceneError(Problem.error(Code.OpenBlock, at, message, help))
      val done = outer.headOption.fold("ignored")(b => s"closing the ${b.begin} at ${b.pos}")
      warn(Problem.warning(Code.OpenBlock, at, s"$message; $done", help))

  private def close(block: OpenBlock): Unit =
    val transforms = state.withTransformsOf(block.saved)
    val isMore = block.begin != "TransformBegin" || transforms == block.saved || isV4()
    state = if isMore then block.saved else transforms

  /** Problems for all blocks left open. */
  def unclosed: Vector[Problem] =
    if isDoubtful then Vector.empty
    else
      openBlocks.reverse.toVector.map: block =>
        val help = Some(s"add a matching ${block.end}")
        val message = s"${block.begin} is never closed"
        if isV4() then Problem.error(Code.OpenBlock, block.pos, message, help)
        else Problem.warning(Code.OpenBlock, block.pos, message, help)

  /** Runs `body` with an empty block stack, then restores stack and state. */
  def isolated(body: => Unit): Vector[Problem] =
    val (savedOpen, savedState) = (openBlocks, state)
    openBlocks = Nil
    try
      body
      unclosed
    finally
      openBlocks = savedOpen
      state = savedState
