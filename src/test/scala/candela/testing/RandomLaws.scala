package candela.testing

import java.time.{LocalDate, ZoneOffset}

import org.scalatest.exceptions.TestFailedException
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** How many random trials a law gets, and with which random numbers.
  *
  * @param share of the trials that a law has in all: one in so many
  * @param base  of the seeds; 0: each law's own, the same in every run
  */
final class TrialPlan(share: Int, base: Long):
  def isFull: Boolean = share == 1
  def count(all: Int): Int = Math.max(1, all / share)
  def count(all: Long): Long = Math.max(1L, all / share)

  /** The seed of a sequence that has the number `own` in its law. */
  def seed(own: Long): Long = own + base * TrialPlan.SeedStride

object TrialPlan:
  /** All trials, with the same random numbers in every run. */
  val Full: TrialPlan = TrialPlan(share = 1, base = 0)

  private val QuickShare = 10

  /** Seeds of different days are far apart: a prime beyond all that laws use. */
  private val SeedStride = 1_000_003L

  /** Of the day, in UTC, or what CANDELA_TEST_SEED says. */
  lazy val daySeed: Long =
    val seed =
      sys.env.get("CANDELA_TEST_SEED").fold(LocalDate.now(ZoneOffset.UTC).toEpochDay)(_.toLong)
    println(s"Random trials have the seed of the day: CANDELA_TEST_SEED=$seed repeats them.")
    seed

  /** A tenth of the trials, with the seed of the day. */
  def quick: TrialPlan = TrialPlan(QuickShare, daySeed)

  /** Checks with a tenth of the trials. What chance may explain in few trials, it doesn't in all:
    * if the check fails, it is repeated with ten times as many, and these decide.
    */
  def quickly(check: TrialPlan => Unit): Unit =
    try check(quick)
    catch
      case _: TestFailedException =>
        try check(TrialPlan(share = 1, daySeed))
        catch
          case e: TestFailedException =>
            throw e.modifyMessage(_.map(m => s"$m (CANDELA_TEST_SEED=$daySeed)"))

/** Suites that try laws with random numbers. Each law is two tests: in every run, a tenth of the
  * trials with the seed of the day, so that in time all are tried; among the slow tests, all trials
  * with the same random numbers in every run.
  */
trait RandomLaws extends AnyFunSuite:
  protected def law(name: String)(check: TrialPlan => Unit): Unit =
    test(name)(TrialPlan.quickly(check))
    test(s"$name, in all trials", Slow)(check(TrialPlan.Full))
