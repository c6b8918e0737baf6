package candela.stability

import candela.bench.robustness.Trials
import candela.testing.RandomLaws

/** A hard case of arithmetic, checked with as many random trials as are asked for.
  *
  * @param quick    trials in every run of the tests
  * @param long     trials of [[LongRun]]
  * @param kind     more words by which [[LongRun]] finds it, and under which it counts them
  * @param isSliced whether slices differ; else there is one only
  */
final class Case private (
    val name: String,
    val quick: Int,
    val long: Long,
    val kind: String,
    val isSliced: Boolean
)(val check: Trials => Unit)

object Case:
  def apply(name: String, quick: Int, long: Long)(check: Long => Unit): Case =
    new Case(name, quick, long, name, isSliced = false)(trials => check(trials.count))

  /** One whose many trials can be taken in parts, and counted where they were stopped. */
  def sliced(name: String, quick: Int, long: Long, kind: String)(check: Trials => Unit): Case =
    new Case(name, quick, long, kind, isSliced = true)(check)

/** A group of cases; [[LongRun]] knows all groups. */
abstract class Group(val cases: Seq[Case])

/** Tests a group with its quick counts. */
abstract class GroupSuite(group: Group) extends RandomLaws:
  for c <- group.cases do
    law(c.name): plan =>
      val slice = if c.isSliced then plan.seed(0).toInt else 0
      c.check(Trials(plan.count(c.quick.toLong), slice))
