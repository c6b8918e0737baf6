package candela.build

import candela.build.recipe.Findings
import candela.scenefile.Declaration

/** Remembers what was made of the last statement, for those after it that say the same: of a
  * million spheres of one radius, one is read.
  *
  * Only what was made without a word is kept, so that each statement gets its own message.
  */
private[build] final class Alike[T](problems: Findings):
  private var last: Option[(Declaration, T)] = None

  /** @param serves whether what was made is the same for all statements that are alike */
  def apply(statement: Declaration, serves: T => Boolean)(make: => T): T = last match
    case Some((earlier, made)) if earlier.isAlike(statement) => made
    case _ =>
      val before = problems.reported
      val made = make
      last = Option.when(problems.reported == before && serves(made))(statement -> made)
      made
