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
      val reports = problems.reported
      val value = make
      val isKept = problems.reported == reports && (serves(value) || through(value).isDefined)
      last = Option.when(isKept)(statement -> value)
      value
    last match
      case Some((earlier, value)) if serves(value) =>
        if earlier.isAlike(statement) then value else fresh
      case Some((earlier, value)) if earlier.isAlikeBut("P", statement) =>
        val varied =
          for
            through <- through(value)
            points <- statement.param("P")
            other <- through(points.floats)
          yield other
        varied.getOrElse(fresh)
      case _ => fresh
