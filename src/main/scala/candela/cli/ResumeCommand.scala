package candela.cli

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
      FilmInput.fail(s"`${film.path}` is a merger of shards; resume the shards, and merge them")
    val hasGoal = options.film.time.isDefined || options.film.error.isDefined
    val saved = FilmInput.options(film, options)
    val samples = options.spp.orElse:
      Option.when(hasGoal && header.isComplete)(ResumeCommand.Most)
    val now = saved.copy(
      spp = samples.orElse(saved.spp),
      outfiles = header.outfiles.map(FilmInput.at(film, _)),
      film = options.film.copy(shard = candela.render.Shard(header.shards.head, header.count))
    )
    RenderCommand(now, terminal, report, loader, Some(film)).run()

private[cli] object ResumeCommand:
  /** Samples per pixel at which a rendering ends even if its goal is not reached. */
  val Most: Int = 1 << 20
