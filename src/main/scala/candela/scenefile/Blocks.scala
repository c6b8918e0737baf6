package candela.scenefile

import candela.base.{Problem, SceneError, SourcePos}

/** The graphics state and the blocks that saved earlier ones.
  *
  * @param isV4 in which `TransformEnd` brings back everything, not the transforms only, and blocks
  *             must be balanced
  * @param warn hears of blocks that are not, where that is no error
  */
final class Blocks(isV4: () => Boolean, warn: Problem => Unit):
  private var open = List.empty[OpenBlock]

  /** What holds now. */
  var state = GraphicsState()

  /** Has a statement been skipped, so that blocks may be unbalanced for that reason alone? */
  var isDoubtful = false

  def begin(directive: String, at: SourcePos): Unit =
    open = OpenBlock(directive, at, state) :: open

  /** Closes the innermost block, which should be a `begin`. */
  def end(begin: String, at: SourcePos): Unit =
    open match
      case block :: rest if block.begin == begin =>
        close(block)
        open = rest
      case _ => recover(begin, at)

  /** Closes what can be closed, and complains: v4 stops here, the older ones go on. */
  private def recover(begin: String, at: SourcePos): Unit =
    val name = begin.replace("Begin", "End")
    val isOld = !isV4()
    // in v2 and v3 objects are attribute blocks, and the end of either ends the innermost
    val ends =
      if isOld && begin != "TransformBegin" then Set("AttributeBegin", "ObjectBegin")
      else Set(begin)
    val (inner, rest) = open.span(b => !ends(b.begin))
    rest.headOption.foreach: block =>
      close(block)
      open = rest.tail
    if !isDoubtful then
      val crossed = inner.headOption.orElse(rest.headOption).filter(_ => rest.nonEmpty)
      val message = crossed match
        case Some(block) => s"$name, but the ${block.begin} at ${block.at} is still open"
        case None => s"$name without $begin"
      val help = crossed.map(block => s"write ${block.end} first")
      if !isOld then throw SceneError(Problem.error(at, message, help))
      val done = rest.headOption.fold("it is ignored")(b => s"it ends the ${b.begin} at ${b.at}")
      warn(Problem.warning(at, s"$message; $done", help))

  private def close(block: OpenBlock): Unit =
    val transforms = state.withTransformsOf(block.saved)
    val isMore = block.begin != "TransformBegin" || transforms == block.saved || isV4()
    state = if isMore then block.saved else transforms

  /** Problems of all blocks that were never closed. */
  def unclosed: Vector[Problem] =
    if isDoubtful then Vector.empty
    else
      open.reverse.toVector.map: block =>
        val help = Some(s"write ${block.end} after it")
        val message = s"${block.begin} is never closed"
        if isV4() then Problem.error(block.at, message, help)
        else Problem.warning(block.at, message, help)

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
