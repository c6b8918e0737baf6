package candela.base

import scala.collection.mutable

/** Gives each name once: to the next that wants it, another one with a number.
  *
  * @param numbered the name with a number from 2 on
  */
final class NumberedNames(numbered: (String, Int) => String = (name, number) => s"$name $number"):
  private val names = mutable.HashSet.empty[String]

  /** The first numbers that may be free. */
  private val numbers = mutable.HashMap.empty[String, Int]

  def apply(wanted: String): String =
    if names.add(wanted) then wanted
    else
      var number = numbers.getOrElse(wanted, 2)
      while !names.add(numbered(wanted, number)) do number += 1
      numbers(wanted) = number + 1
      numbered(wanted, number)
