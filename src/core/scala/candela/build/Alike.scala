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

  /** @param serves  whether what was made is the same for all statements that are alike
    * @param through what becomes of it with other points `P`, if these alone are others; None where
    *   it is to be made anew
    */
  def apply(
      statement: Declaration,
      serves: T => Boolean,
      through: T => Option[Array[Float] => Option[T]] = (_: T) => None
  )(make: => T): T =
    def fresh =
      val before = problems.reported
      val made = make
      val isKept = problems.reported == before && (serves(made) || through(made).isDefined)
      last = Option.when(isKept)(statement -> made)
      made
    last match
      case Some((earlier, made)) if serves(made) =>
        if earlier.isAlike(statement) then made else fresh
      case Some((earlier, made)) if earlier.isAlikeBut("P", statement) =>
        val varied =
          for
            through <- through(made)
            points <- statement.param("P")
            other <- through(points.floats)
          yield other
        varied.getOrElse(fresh)
      case _ => fresh
