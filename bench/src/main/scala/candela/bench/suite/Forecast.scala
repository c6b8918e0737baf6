package candela.bench.suite

import scala.collection.mutable

/** Estimates the remaining time of a suite: each run as long as the same program took for the same
  * step on the same scene, else on other scenes, else as other programs took.
  */
private[suite] final class Forecast(runs: Vector[Forecast.Run]):
  import Forecast.*

  private val remaining = mutable.Map.from(runs.groupMapReduce(identity)(_ => 1)(_ + _))
  private val times = mutable.Map.empty[Run, Vector[Double]]
  private var done = 0

  /** @param seconds time of the run; None if it failed */
  def ended(job: Job, seconds: Option[Double]): Unit =
    val run = Run(job.entry.program.name, job.entry.scene.name, job.step)
    done += 1
    remaining.updateWith(run)(_.map(_ - 1).filter(_ > 0)): Unit
    for s <- seconds do times(run) = times.getOrElse(run, Vector.empty) :+ s

  /** A run will be repeated. */
  def again(job: Job): Unit =
    val run = Run(job.entry.program.name, job.entry.scene.name, job.step)
    remaining.updateWith(run)(n => Some(n.getOrElse(0) + 1)): Unit

  /** Drops the runs of `entry` from `step` on, and those of first images, if it has none. */
  def dropFrom(entry: Entry, step: Int, hasFirstImage: Boolean): Unit =
    def isOf(run: Run) = run.program == entry.program.name && run.scene == entry.scene.name
    remaining.filterInPlace((run, _) =>
      !isOf(run) ||
        (if run.step == Job.FirstImage then hasFirstImage else 0 <= run.step && run.step < step)
    ): Unit

  /** None until some program has completed one of the steps. */
  def secondsLeft: Option[Double] =
    val all = remaining.toVector.map((run, count) => expected(run).map(_ * count))
    Option.when(all.forall(_.isDefined))(all.flatten.sum)

  def words: String =
    val time = secondsLeft match
      case None | Some(0.0) => ""
      case Some(s) if s < 90 => f", about $s%.0f s left"
      case Some(s) => f", about ${s / 60}%.0f min left"
    s"[$done of ${done + remaining.values.sum}$time]"

  private def expected(run: Run): Option[Double] =
    def mean(like: Run => Boolean) =
      val measured = times.filter((r, _) => like(r)).values.flatten.toVector
      Option.when(measured.nonEmpty)(measured.sum / measured.size)
    mean(_ == run)
      .orElse(mean(r => r.program == run.program && r.step == run.step))
      .orElse(mean(_.step == run.step))

private[suite] object Forecast:
  /** Of a [[TimeCurve]], about. */
  private val Trials = 4

  /** @param step step of the [[Job]] */
  final case class Run(program: String, scene: String, step: Int)

  /** All runs of a program on a scene. */
  def runs(entry: Entry, suite: Suite): Vector[Run] =
    val (pilots, steps, firstImages) = entry.scene.work.getOrElse(suite.work) match
      case Work.Samples(counts) => (1, counts.size, if counts.contains(1) then 0 else suite.seeds)
      case Work.Seconds(budgets) => (Trials, budgets.size, suite.seeds)
    def run(step: Int) = Run(entry.program.name, entry.scene.name, step)
    Vector.fill(pilots)(run(Job.WarmUp)) ++ Vector.fill(firstImages)(run(Job.FirstImage)) ++
      (0 until steps).flatMap(k => Vector.fill(suite.seeds)(run(k)))
