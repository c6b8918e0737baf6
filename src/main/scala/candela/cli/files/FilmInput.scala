package candela.cli.files

import candela.diagnostics.Code
import candela.io.{InputFile, SceneFolder}
import candela.cli.options.Options
import candela.cli.terminal.Report
import candela.job.{FilmHeaders, FilmKeeper, Render, SceneLoader}
import candela.render.storage.FilmFile

import java.nio.file.{Files, Path}

/** Reads film files, and finds their scenes. */
private[cli] object FilmInput:

  /** Opens a film file; warns if its previous copy has to be used.
    *
    * @throws SceneError if it can't be read, or is another version's
    */
  def open(name: String, report: Report): FilmFile =
    FilmKeeper.open(OutputFiles.path(name), p => report.warnings(Vector(p), all = true))

  /** The options of the rendering, with its scene as found from here.
    *
    * @param now options of this command
    */
  def options(film: FilmFile, now: Options): Options =
    if FilmHeaders.isMadeInCode(film.header) then
      FilmKeeper.fail(
        Code.OtherRendering,
        s"a program has made the scene of `${film.path}`, which is in no file",
        "that program continues it, and has its image: RenderControl.withFilm of the library"
      )
    val scene = resolve(film, film.header.scene)
    val file = OutputFiles.path(scene)
    if now.control.limits.sandbox then
      val folder = SceneFolder.of(film.path, isConfined = true)
      val _ = Render.withinLimits()(folder.scene(file))
    // The film names it, and its user may not know it
    for why <- InputFile.obstacle(file) if film.header.text.isEmpty do
      FilmKeeper.fail(Code.Unreadable, s"can't read `$scene`, the scene of `${film.path}`: $why")
    if film.header.text.isEmpty && !Files.exists(file) then
      FilmKeeper.fail(
        Code.NoSuchScene,
        s"no such scene file: `$scene`, the scene of `${film.path}`",
        "a film that is moved needs its scene in the same place beside it"
      )
    Options(
      files = Vector(scene),
      settings = FilmHeaders.settings(film.header).copy(goal = now.settings.goal),
      control = now.control,
      keepsScenes = now.keepsScenes,
      sceneFolder = now.sceneFolder,
      quiet = now.quiet,
      verbose = now.verbose,
      film = now.film
    )

  /** Loads the scene of the rendering, which may be no file. */
  def loader(film: FilmFile, files: SceneLoader): SceneLoader =
    film.header.text.fold(files)(SceneLoader.OfText(resolve(film, film.header.scene), _, files))

  /** A file named by the rendering, as found from here. */
  def resolve(film: FilmFile, name: String): String =
    val folder = film.path.toAbsolutePath.getParent.resolve(film.header.folder).normalize
    if folder == Path.of("").toAbsolutePath then name else folder.resolve(name).toString
