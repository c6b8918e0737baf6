package candela.bench.suite

import candela.bench.report.{ProgramResult, SceneResult, SuiteReport}
import candela.bench.statistics.{MeasuredCurve, Statistics}
import candela.report.Machine

import java.nio.file.Path
import java.time.LocalDateTime
import java.time.format.DateTimeFormatter

/** Runs a suite and assembles the results. */
object SuiteResults:

  /** @param scratch folder for temporary images; the caller deletes it
    * @param isCancelled polled; cancellation returns the results so far
    * @param publish receives the results after each scene, so that a crash loses at most one
    * @param leftOut what is not in the suite, and why
    */
  def of(
      suite: Suite,
      self: Vector[String],
      scratch: Path,
      version: String,
      log: String => Unit,
      isCancelled: () => Boolean = () => false,
      publish: SuiteReport => Unit = _ => (),
      leftOut: Vector[(String, String)] = Vector.empty
  ): SuiteReport =
    val names = PublicNames.of(suite, scratch)
    val machine = Machine.current()
    val begun = LocalDateTime.now.format(DateTimeFormatter.ofPattern("yyyy-MM-dd HH:mm"))
    val started = System.nanoTime
    val commands = Commands(self, scratch, isCancelled)
    val runner = SuiteRunner(suite, commands, scratch, names, log, isCancelled)
    def report(results: Vector[Result]): SuiteReport =
      val seconds = (System.nanoTime - started) * 1e-9
      val scenes = suite.scenes.flatMap: scene =>
        val ofScene = results.filter(_.job.entry.scene == scene)
        Option.when(ofScene.exists(_.job.isPoint))(sceneResult(
          scene, suite, ofScene, runner, names
        ))
      SuiteReport(
        suite.title,
        version,
        machine,
        begun,
        seconds,
        suite.seeds,
        scenes,
        leftOut.map((what, why) => what -> names.of(why)) ++ runner.omissions
      )
    machine.business.foreach(words => log(s"warning: $words"))
    for (what, why) <- leftOut do log(s"skipped: $what: ${names.of(why)}")
    val results = report(runner.run(results => publish(report(results))))
    results.disturbances.foreach(words => log(s"warning: $words"))
    results

  private def sceneResult(
      scene: SuiteScene,
      suite: Suite,
      results: Vector[Result],
      runner: SuiteRunner,
      names: PublicNames
  ): SceneResult =
    val byEntry = results.groupBy(_.job.entry).filter((_, all) => all.exists(_.job.isPoint))
    val programs = suite.programs.flatMap: program =>
      byEntry.collectFirst { case (entry, all) if entry.program == program => entry -> all }
        .map((entry, all) => programResult(entry, all, runner, names))
    val (reference, makers) = runner.reference(scene)
    val voters = suite.voters(p => programs.exists(_.name == p.name)).map(_.name)
    val errors = programs.filter(p => voters.contains(p.name)).map(_.curve.lowestError)
    SceneResult(
      scene.name,
      scene.title,
      scene.note,
      reference,
      scene.reference.map(_.getFileName.toString),
      scene.target.getOrElse(reachable(errors)),
      programs,
      makers.map(_.title),
      runner.biases(suite.programs.flatMap(p => byEntry.keys.find(_.program == p))),
      scene.growth
    )

  /** Error that at least half of them reach. */
  private[suite] def reachable(errors: Vector[Double]): Double =
    val target = errors.sorted.apply(errors.size / 2)
    // Rounded up to two digits, for legibility.
    val digit = Math.pow(10, Math.floor(Math.log10(Math.max(target, 1e-12))) - 1)
    Math.ceil(target / digit - 1e-9) * digit

  private def programResult(
      entry: Entry,
      results: Vector[Result],
      runner: SuiteRunner,
      names: PublicNames
  ): ProgramResult =
    val program = entry.program
    val measurements = results.filter(_.job.isPoint).map(_.measurement)
    val first = results.filter(_.job.samples == 1).map(_.measurement.seconds)
    val times = measurements.groupMap(_.samples)(_.seconds)
    // Repeating the same image adds no information about the error.
    val independent = if program.isSeeded then measurements else measurements.distinctBy(_.samples)
    ProgramResult(
      program.name,
      program.title,
      program.color,
      program.isThin,
      names.of(program.command.mkString(" "), program.needs).replace(Commands.Self, "candela") +
        program.edits.map(e => s"; /${e.find}/ → ${e.replacement}").mkString,
      MeasuredCurve(independent, times),
      runner.picture(entry),
      Option.when(first.nonEmpty)(Statistics.median(first)),
      runner.otherShare(entry)
    )
