package candela.build.recipe

import scala.collection.mutable

/** How large compositions of named things are: each is evaluated by what it is a part of, as often
  * as other things name it.
  *
  * @param most    number of parts, counted as often as they are named
  * @param deepest number of parts within each other
  */
private[recipe] final class Compositions(most: Int, deepest: Int):
  import Compositions.*
  private val sizes = mutable.HashMap.empty[(String, String), Size]
  private var named = mutable.HashSet.empty[(String, String)]

  /** Notes that the thing in the making has a part of this kind and name. */
  def refer(kind: String, name: String): Unit = named += ((kind, name)): Unit

  /** Makes a thing.
    *
    * @param isPlain whether its parts are not evaluated any more
    * @param lighten makes one of it that takes little time, if it is too large; or tells in words
    *   why it is
    */
  def composed[A](kind: String, name: String)(make: => A)(
      isPlain: A => Boolean,
      lighten: (A, String) => Either[String, A] = (_: A, why: String) => Left(why)
  ): Either[String, A] =
    val outer = named
    named = mutable.HashSet.empty
    try
      val result = make
      val partSizes = if isPlain(result) then Vector.empty else named.toVector.flatMap(sizes.get)
      val count = partSizes.map(_.count).sum
      val depth = partSizes.map(_.depth).maxOption.getOrElse(0)
      val isTooLarge = count > most || depth > deepest
      sizes((kind, name)) = if isTooLarge then Size(1, 1) else Size(count + 1, depth + 1)
      if count > most then
        lighten(
          result,
          s"$count others, each counted as often as it is named; the maximum is $most"
        )
      else if depth > deepest then
        lighten(result, s"$depth others within each other; the maximum is $deepest")
      else Right(result)
    finally named = outer

private[recipe] object Compositions:
  private final case class Size(count: Long, depth: Int)
