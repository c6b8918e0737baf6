package candela.cli.commands

import candela.diagnostics.Code
import candela.cli.files.{FilmInput, FilmKeeping, OutputFiles}
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.job.{FilmHeaders, FilmKeeper, SceneLoader}
import candela.render.{RenderPlan, Shard}
import candela.render.storage.FilmFile

import scala.util.Using

/** `candela resume`: continues saved renderings, or adds samples. */
final class ResumeCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):
  def run(): ExitCode =
    report.guarded:
      val name = options.files.head
      Using.resource(FilmKeeping.locked(OutputFiles.path(name))): _ =>
        resume(FilmInput.open(name, report))

  private def resume(film: FilmFile): ExitCode =
    val header = film.header
    if header.shards.size != 1 then
      FilmKeeper.fail(
        Code.NothingToAdd,
        s"`${film.path}` is a merger of shards; resume the shards, and merge them"
      )
    val setsSamples = options.settings.goal.isGiven || options.settings.samples.isDefined
    if setsSamples && FilmHeaders.isAdaptive(header) then
      FilmKeeper.fail(
        Code.NothingToAdd,
        s"can't add samples to `${film.path}`: its sampler \"adaptive\" decides on their number",
        "resume without --spp, --error and --time; or render the scene again with one of them"
      )
    val saved = FilmInput.options(film, options).copy(
      outfiles = header.outfiles.map(FilmInput.resolve(film, _)),
      film = options.film.copy(shard = Shard(header.shards.head, header.count))
    )
    // A goal goes beyond the number of samples, to which points and footprints still belong
    val sampleLimit =
      if options.settings.goal.isGiven then RenderPlan.Endless
      else Math.max(header.samples, header.done)
    val resumed = options.settings.samples match
      case Some(samples) => saved.setting(_.copy(samples = Some(samples)))
      case None if saved.settings.samples.isEmpty => saved
      case None =>
        val footprint = Option(header.footprint).filter(_ > 0)
        saved.controlling(_.copy(samples = Some(sampleLimit), footprint = footprint))
    RenderCommand(resumed, terminal, report, FilmInput.loader(film, loader), Some(film)).run()
