package candela.cli.rendering

import candela.diagnostics.{Code, Problem, SceneError, SourcePos}
import candela.aov.Layer
import candela.cli.files.{FileRegister, FilmKeeping, FilmName, Frame, Output, OutputFiles}
import candela.cli.options.{FilmOptions, Options}
import candela.cli.terminal.Report
import candela.job.{Prepared, SceneLoader}
import candela.render.storage.FilmFile
import candela.scenefile.SceneFiles

import java.nio.file.{Files, Path}

/** The files that a rendering reads and writes. */
private[cli] final class RenderOutputs(
    options: Options,
    report: Report,
    register: FileRegister,
    resumed: Option[FilmFile]
):

  /** Checks that no two scenes have one image, before any of them is rendered: that would lose
    * hours. Scenes that can't be read tell nothing yet, and missing ones take no time.
    *
    * @throws SceneError if two have
    */
  def checkAll(frames: Vector[Frame], loader: SceneLoader): Unit =
    if frames.size > 1 then
      val together = FileRegister()
      for Frame(scene, outfiles, _, _) <- frames if Files.exists(OutputFiles.path(scene)) do
        val images =
          if outfiles.nonEmpty then Some(OutputFiles.requested(outfiles))
          else
            loader.imageName(scene, options.settings.reading, options.building)
              .map(OutputFiles.named(scene, _))
        for files <- images do together.note(Output(files.paths, "image", scene))
        for film <- outfiles.find(FilmOptions.isFilm) do
          together.note(Output.film(OutputFiles.path(film), scene))

  /** Checks what is known before the scene is read, which may take long.
    *
    * @throws SceneError if a file can't be written
    */
  def check(scene: String, outfiles: Vector[String]): Unit =
    val images = OutputFiles.requested(outfiles)
    if options.control.limits.sandbox then register.confine(folders(scene, outfiles))
    images.check()
    register.read((scene +: (options.reference ++ options.settings.output.reference).toVector)
      .map(OutputFiles.path))
    register.check(Output(images.paths, "image", scene))
    val film = if resumed.isDefined then None else FilmKeeping.named(options, outfiles)
    extraOutputs(
      scene,
      film.map(OutputFiles.path),
      options.settings.output.errors,
      at = None
    ).foreach(register.check)

  /** The images to write, each by one scene.
    *
    * @throws SceneError if a file can't be written, or is one of the scene's
    */
  def images(scene: String, loaded: Prepared, outfiles: Vector[String]): Vector[Path] =
    val plan = loaded.plan
    register.read(SceneFiles.of(loaded.description) ++
      plan.errors.map(e => OutputFiles.path(e.reference)))
    val files =
      if outfiles.nonEmpty then OutputFiles.requested(outfiles)
      else if resumed.isDefined then OutputFiles.requested(Vector.empty) // a shard
      else OutputFiles.ofScene(scene, loaded).excluding(register.hasRead)
    report.warnings(files.warnings, all = true)
    files.check()
    if OutputFiles.needLayers(plan, options.settings.output.denoise) && files.paths.nonEmpty then
      files.checkLayers()
    if options.settings.layers.contains(Layer.Alpha) && files.paths.nonEmpty then files.checkAlpha()
    val pos = if outfiles.isEmpty then FilmName.position(loaded.description) else None
    // Those of a film are not named now
    val isAsked = outfiles.nonEmpty && resumed.isEmpty
    for path <- files.paths.intersect(files.strategies(plan)) if isAsked do
      val message = s"`$path` is the file of a strategy of bdpt; the image needs another name"
      throw SceneError(Problem.general(Code.OutputConflict, message))
    val all = files.withStrategies(plan).paths
    register.write(Output(all, "image", scene, pos = pos, isAsked = isAsked))
    val film = FilmKeeping.path(options, outfiles, files.paths, resumed)
    val errorsAt = loaded.description.options.find(_.name == "msereferenceout").map(_.valuesAt)
    extraOutputs(scene, film, plan.errors.map(_.file), errorsAt).foreach(register.write)
    all

  /** Where a sandbox lets files be written. */
  private def folders(scene: String, outfiles: Vector[String]): Vector[Path] =
    val beside = resumed.map(_.path).toVector ++ outfiles.map(OutputFiles.path)
    val paths = if beside.isEmpty then Vector(OutputFiles.path(scene)) else beside
    paths.map(file => Option(file.getParent).getOrElse(Path.of(""))).distinct

  /** @param at where the scene names the list of errors */
  private def extraOutputs(
      scene: String,
      film: Option[Path],
      errors: Option[String],
      at: Option[SourcePos]
  ): Vector[Output] =
    val isAsked = options.settings.output.errors.nonEmpty
    val named = if options.film.checkpoint.isDefined then "checkpoint" else "outfile"
    film.toVector.map(Output.film(_, scene, named)) ++ Vector(
      Output(ReportFiles.checked(options.reports), "report", scene, "report"),
      Output(
        errors.toVector.map(OutputFiles.path),
        "list of errors",
        scene,
        "mse-reference-out",
        pos = at.filterNot(_ => isAsked),
        isAsked = isAsked
      )
    )
