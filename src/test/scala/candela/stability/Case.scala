package candela.stability

import org.scalatest.funsuite.AnyFunSuite

/** A hard case of arithmetic, checked with as many random trials as are asked for.
  *
  * @param quick trials in every run of the tests
  * @param long  trials of [[LongRun]]
  * @param kind  more words by which [[LongRun]] finds it
  */
final class Case(val name: String, val quick: Int, val long: Long, val kind: String = "")(
    val check: Long => Unit
)

/** A group of cases; [[LongRun]] knows all groups. */
abstract class Group(val cases: Seq[Case])

/** Tests a group with its quick counts. */
abstract class GroupSuite(group: Group) extends AnyFunSuite:
  for c <- group.cases do test(c.name)(c.check(c.quick.toLong))
