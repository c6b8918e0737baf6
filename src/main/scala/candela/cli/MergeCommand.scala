package candela.cli

import candela.render.{RenderState, Renderer}
import candela.render.storage.{FilmFile, FilmHeader, FilmWriter}
import candela.scenefile.SceneFiles

import scala.util.Using

/** `candela merge`: adds up film files of the shards of a rendering. */
final class MergeCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):
  def run(): ExitCode =
    report.guarded:
      val films = options.files.map(FilmInput.open(_, report))
      val first = films.head
      for film <- films.tail; difference <- first.header.difference(film.header) do
        FilmInput.fail(s"`${film.path}` is of another rendering than `${first.path}`: $difference")
      checkShards(films)
      val outfiles = OutputFiles.asked(options.outfiles)
      outfiles.check()
      val register = FileRegister()
      register.read(films.flatMap(f => Vector(f.path, FilmFile.previous(f.path))))
      val merged = options.outfiles.find(FilmOptions.isFilm).map(OutputFiles.path).toVector
      val outputs = Output(outfiles.paths, "image", first.path.toString) +:
        merged.map(Output.film(_, first.path.toString))
      outputs.foreach(register.check)
      val saved = FilmInput.options(first, options)
      val loaded = loader.load(saved.files.head, saved)
      val header = first.header
      val images = header.outfiles.map(OutputFiles.path)
      val now = FilmHeaders.of(saved, header.scene, loaded, first.path, images)
      register.read(SceneFiles.of(loaded.description))
      outputs.foreach(register.write)
      FilmInput.verify(first, now.copy(count = header.count))
      val shards = films.flatMap(_.header.shards).toSet
      val all = films.map(_.header.done).min
      val done = if shards.size == header.count then all else all * shards.size / header.count
      val film = header.copy(shards = shards, done = all)
      write(film, films, outfiles, loaded, saved, done)

  private def write(
      header: FilmHeader,
      films: Vector[FilmFile],
      outfiles: OutputFiles,
      loaded: LoadedScene,
      saved: Options,
      done: Int
  ): ExitCode =
    val merged = options.outfiles.find(FilmOptions.isFilm).map(OutputFiles.path)
    def load(state: RenderState): Unit =
      films.foreach(_.load(state))
      for path <- merged do
        Using.resource(FilmKeeping.locked(path)): _ =>
          val writer = FilmWriter(path)
          writer.write(
            if header.isWhole then header.copy(shards = Set(0), count = 1) else header,
            state
          )
          writer.commit()
        if !options.quiet then terminal.out.println(s"wrote $path")
    val rendering = Renderer.gather(loaded.plan, load)
    val planned = if options.film.partial then done else header.samples
    RenderCommand(saved, terminal, report, loader)
      .finish(
        header.scene,
        loaded,
        outfiles.paths,
        rendering.copy(samplesDone = done, samplesPerPixel = planned)
      )

  /** Names missing, doubled and unfinished shards. */
  private def checkShards(films: Vector[FilmFile]): Unit =
    val count = films.head.header.count
    val owners = films.flatMap(f => f.header.shards.map(_ -> f.path)).groupMap(_._1)(_._2)
    for (shard, paths) <- owners.toVector.sortBy(_._1) if paths.size > 1 do
      FilmInput.fail(s"shard $shard/$count is there twice: ${paths.mkString("`", "`, `", "`")}")
    if !options.film.partial then
      val missing = (0 until count).filterNot(owners.contains)
      if missing.nonEmpty then
        val names = missing.map(i => s"$i/$count").mkString(", ")
        val many = if missing.size == 1 then s"shard $names is" else s"shards $names are"
        FilmInput.fail(s"$many missing", "--partial merges the others")
      for film <- films if films.size > 1 && !film.header.isComplete do
        val header = film.header
        FilmInput.fail(
          s"shard ${header.part} is unfinished, with ${header.done} of ${header.samples} samples " +
            s"per pixel: `${film.path}`",
          s"`candela resume ${film.path}` completes it; --partial merges what there is"
        )
