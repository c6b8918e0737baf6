package candela.cli.commands

import candela.diagnostics.{Code, Problem, SceneError, Severity}
import candela.cli.files.{FileRegister, FilmInput, FilmKeeping, Output, OutputFiles}
import candela.cli.options.{FilmOptions, Options}
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.job.{FilmHeaders, FilmKeeper, Prepared, SceneLoader}
import candela.render.RenderState
import candela.render.storage.{FilmFile, FilmHeader}
import candela.scenefile.SceneFiles

import scala.collection.mutable
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
      val films = usable()
      val first = films.head
      val outfiles = OutputFiles.requested(options.outfiles)
      outfiles.check()
      val register = FileRegister()
      if options.control.limits.sandbox then
        val folders = options.outfiles.map(OutputFiles.path).map(_.toAbsolutePath.getParent)
        register.confine(folders.distinct)
      register.read(films.flatMap(f => Vector(f.path, FilmFile.previous(f.path))))
      val merged = options.outfiles.find(FilmOptions.isFilm).map(OutputFiles.path).toVector
      val outputs = Output(outfiles.paths, "image", first.path.toString) +:
        merged.map(Output.film(_, first.path.toString))
      outputs.foreach(register.check)
      val saved = FilmInput.options(first, options)
      val scenes = FilmInput.loader(first, loader)
      Using.resource(scenes.load(saved.files.head, saved.sceneSettings, saved.building)): loaded =>
        merge(films, loaded, saved, outfiles, outputs, register)

  private def merge(
      films: Vector[FilmFile],
      loaded: Prepared,
      saved: Options,
      outfiles: OutputFiles,
      outputs: Vector[Output],
      register: FileRegister
  ): ExitCode =
    val first = films.head
    val header = first.header
    val images = header.outfiles.map(OutputFiles.path)
    val expected = FilmHeaders.of(saved.settings, header.scene, loaded, first.path, images)
    register.read(SceneFiles.of(loaded.description))
    val all = outfiles.withStrategies(loaded.plan)
    val strategies = Output(all.paths.diff(outfiles.paths), "image", first.path.toString)
    (outputs :+ strategies).foreach(register.write)
    FilmKeeper.verify(first, expected.copy(count = header.count))
    try write(films, all, loaded, saved)
    catch
      case e: SceneError if options.film.partial =>
        val sound = this.sound(films, loaded)
        if sound.size == films.size then throw e
        write(sound, all, loaded, saved)

  /** The films whose states are sound; the others are left out with a warning, unless all are. */
  private def sound(films: Vector[FilmFile], loaded: Prepared): Vector[FilmFile] =
    def damage(film: FilmFile) =
      try
        val _ = loaded.gather(film.load)
        Vector.empty
      catch case e: SceneError => e.problems
    val checked = films.map(film => film -> damage(film))
    val bad = checked.flatMap(_._2)
    if checked.forall(_._2.nonEmpty) then throw SceneError(bad)
    leaveOut(bad)
    checked.collect { case (film, Vector()) => film }

  private def leaveOut(bad: Vector[Problem]): Unit = report.warnings(
    bad.map(p => p.copy(severity = Severity.Warning, message = s"${p.message}; it is omitted")),
    all = true
  )

  private def write(
      films: Vector[FilmFile],
      outfiles: OutputFiles,
      loaded: Prepared,
      saved: Options
  ): ExitCode =
    val header = films.head.header.merging(films.map(_.header))
    val merged = options.outfiles.find(FilmOptions.isFilm).map(OutputFiles.path)
    def load(state: RenderState): Unit =
      films.foreach(_.load(state))
      for path <- merged do
        Using.resource(FilmKeeping.locked(path)): _ =>
          Prepared.write(header.joined, state, path)
        if !options.quiet then terminal.out.println(s"wrote $path")
    val rendering = loaded.gather(load)
    val done = FilmHeader.averageDone(films.map(_.header))
    val planned = if options.film.partial then done else header.samples
    val command = RenderCommand(saved, terminal, report, loader)
    val writer = command.writer(saved, header.scene, loaded, outfiles.paths)
    command.finish(
      writer,
      loaded,
      rendering.copy(samplesDone = done, samplesPerPixel = planned)
    )

  /** The films that can be merged. With `--partial`, the others are left out with a warning;
    * otherwise they are errors, all of them.
    */
  private def usable(): Vector[FilmFile] =
    val opened = options.files.map: name =>
      try Right(FilmInput.open(name, report))
      catch case e: SceneError => Left(e.problems)
    val (own, foreign) = ofOneRendering(opened.flatMap(_.toOption))
    val (single, doubled) = withoutDoubles(own)
    val bad = opened.flatMap(_.left.toOption).flatten ++ foreign ++ doubled
    if options.film.partial && single.nonEmpty then
      leaveOut(bad)
    else
      val gaps = if bad.isEmpty && !options.film.partial then missing(single) else Vector.empty
      val problems =
        bad ++ gaps ++ (if options.film.partial then Vector.empty else unfinished(single))
      if problems.nonEmpty then throw SceneError(problems)
    single

  /** The films of the rendering that most of them are of; and what is wrong with the others. */
  private def ofOneRendering(films: Vector[FilmFile]): (Vector[FilmFile], Vector[Problem]) =
    val groups = films.foldLeft(Vector.empty[Vector[FilmFile]]): (groups, film) =>
      groups.indexWhere(_.head.header.difference(film.header).isEmpty) match
        case -1 => groups :+ Vector(film)
        case i => groups.updated(i, groups(i) :+ film)
    val largest = groups.maxByOption(_.size).getOrElse(Vector.empty)
    val problems =
      for first <- largest.take(1); film <- films; why <- first.header.difference(film.header)
      yield Problem.general(
        Code.OtherRendering,
        s"`${film.path}` and `${first.path}` belong to different renderings: $why"
      )
    (largest, problems)

  /** One film for each shard: that with the most samples, or the first of equals. */
  private def withoutDoubles(films: Vector[FilmFile]): (Vector[FilmFile], Vector[Problem]) =
    val owners = mutable.HashMap.empty[Int, FilmFile]
    val problems = Vector.newBuilder[Problem]
    val unique = films.sortBy(-_.header.done).filter: film =>
      val shards = film.header.shards
      shards.find(owners.contains) match
        case None =>
          owners ++= shards.map(_ -> film)
          true
        case Some(shard) =>
          val paths = s"`${owners(shard).path}`, `${film.path}`"
          problems +=
            Problem.general(
              Code.IncompleteShards,
              s"shard $shard/${film.header.count} is given twice: $paths"
            )
          false
    (films.filter(unique.contains), problems.result())

  private def missing(films: Vector[FilmFile]): Vector[Problem] =
    val count = films.head.header.count
    val gaps = FilmHeader.missing(films.flatMap(_.header.shards).toSet, count)
    val names = FilmHeader.named(gaps, count)
    val isOne = gaps.size == 1 && gaps.forall((first, last) => first == last)
    val subject = if isOne then s"shard $names is" else s"shards $names are"
    Option.when(gaps.nonEmpty):
      Problem.general(
        Code.IncompleteShards,
        s"$subject missing",
        Some("--partial merges the others")
      )
    .toVector

  private def unfinished(films: Vector[FilmFile]): Vector[Problem] =
    for film <- films if films.size > 1 && !film.header.isComplete yield
      val header = film.header
      val isOne = header.shards.size == 1
      val subject = if isOne then s"shard ${header.label} is" else s"shards ${header.label} are"
      val completed =
        if isOne then s"`candela resume ${film.path}` completes it"
        else "`candela resume` completes the film of each shard, from which it was merged"
      Problem.general(
        Code.IncompleteShards,
        s"$subject unfinished, with ${header.done} of ${header.samples} samples " +
          s"per pixel: `${film.path}`",
        Some(s"$completed; --partial merges the samples so far")
      )
