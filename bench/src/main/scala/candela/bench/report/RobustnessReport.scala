package candela.bench.report

import candela.report.{Machine, Picture}

/** What was measured of one thing in one program. */
enum Robust:
  /** @param first the first fault, in words */
  case Counted(faults: Long, trials: Long, first: Option[String] = None)

  /** The mean of a picture.
    *
    * @param error   its standard error
    * @param allowed largest relative difference that is no fault, noise aside
    */
  case Mean(found: Double, error: Double, expected: Double, allowed: Double)

  /** Not measured, and why. */
  case Absent(why: String)

  /** The program gave no answer: it failed, or took too long. */
  case Failed(why: String)

  /** Whether there is a fault. */
  def isFaulty: Boolean = this match
    case Counted(faults, _, _) => faults > 0
    case Mean(found, error, expected, allowed) =>
      !(Math.abs(found - expected) <= allowed * Math.abs(expected) + Robust.Deviations * error)
    case Absent(_) => false
    case Failed(_) => true

object Robust:
  /** Standard errors that are noise: 1 of 100,000 normal numbers is farther off. */
  private final val Deviations = 4.5

/** A program, or a way of computing of one.
  *
  * @param isOurs whether its faults are this program's
  */
final case class RobustProgram(key: String, title: String, isOurs: Boolean)

/** One row of the table.
  *
  * @param cells of programs, by key
  * @param why   a fault of Candela in this row is known, and this is its reason
  * @param pictures by title of the program, where there are some
  */
final case class RobustRow(
    what: String,
    cells: Map[String, Robust],
    why: Option[String] = None,
    pictures: Vector[Picture] = Vector.empty
):
  /** Whether Candela has a fault here without a known reason. */
  def isBroken(programs: Vector[RobustProgram]): Boolean =
    why.isEmpty && programs.exists(p => p.isOurs && cells.get(p.key).exists(_.isFaulty))

/** Rows about one kind of fault.
  *
  * @param key what `--only` calls it
  * @param per number of trials to which counts are converted; 0 if they are shares, or nothing
  *   is counted
  * @param words what is counted, and how
  */
final case class RobustGroup(
    key: String,
    title: String,
    per: Double,
    words: String,
    rows: Vector[RobustRow]
):
  /** Reasons of known faults, each with its rows. */
  def reasons: Vector[(String, Vector[String])] =
    rows.flatMap(r => r.why.map(_ -> r.what)).groupMap(_._1)(_._2).toVector.sortBy(_._1)

/** The results of `candela robustness`.
  *
  * @param rays     trials of each row
  * @param leftOut  programs that are not there, and why
  * @param command  command line that makes the same report
  */
final case class RobustnessReport(
    version: String,
    machine: Machine,
    begun: String,
    seconds: Double,
    rays: Long,
    command: String,
    programs: Vector[RobustProgram],
    groups: Vector[RobustGroup],
    leftOut: Vector[(String, String)]
):
  /** Programs with figures in a group. */
  def programsOf(g: RobustGroup): Vector[RobustProgram] =
    programs.filter(p => g.rows.exists(_.cells.contains(p.key)))

  /** Rows where Candela is not as promised. */
  def broken: Vector[(RobustGroup, RobustRow)] =
    for g <- groups; r <- g.rows if r.isBroken(programs) yield (g, r)
