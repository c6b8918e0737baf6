package candela.cli.files

import candela.base.{InputFile, Problem, SceneError, SceneFolder, Version}
import candela.cli.options.Options
import candela.cli.terminal.Report
import candela.job.{FilmHeaders, SceneLoader}
import candela.render.storage.{FilmFile, FilmHeader}

import java.io.IOException
import java.nio.file.Path

/** Reads film files, and finds their scenes. */
private[cli] object FilmInput:

  /** Opens a film file; warns if its previous copy has to be used.
    *
    * @throws SceneError if it can't be read, or is another version's
    */
  def open(name: String, report: Report): FilmFile =
    val film =
      try FilmFile.open(OutputFiles.path(name))
      catch case e: IOException => fail(e.getMessage)
    for damage <- film.damage do
      val message = s"can't read `$name`: $damage; using its previous copy, " +
        s"`${FilmFile.previous(film.path).getFileName}`"
      report.warnings(Vector(Problem.general(message).copy(severity = Warning)), all = true)
    val version = film.header.version
    if version != Version.current then
      fail(s"`$name` was written by Candela $version; this is ${Version.current}")
    film

  /** The options of the rendering, with its scene as found from here.
    *
    * @param now options of this command
    */
  def options(film: FilmFile, now: Options): Options =
    val scene = at(film, film.header.scene)
    val file = OutputFiles.path(scene)
    if now.limits.sandbox then
      val folder = SceneFolder.of(film.path, isConfined = true)
      val _ = SceneLoader.refusing(folder.scene(file))
    // The film names it, and its user may not know it
    for why <- InputFile.obstacle(file) do
      fail(s"can't read `$scene`, the scene of `${film.path}`: $why")
    Options(
      files = Vector(scene),
      settings = FilmHeaders.settings(film.header).copy(goal = now.settings.goal),
      limits = now.limits,
      threads = now.threads,
      quiet = now.quiet,
      verbose = now.verbose,
      film = now.film
    )

  /** A file named by the rendering, as found from here. */
  def at(film: FilmFile, name: String): String =
    val folder = film.path.toAbsolutePath.getParent.resolve(film.header.folder).normalize
    if folder == Path.of("").toAbsolutePath then name else folder.resolve(name).toString

  /** @throws SceneError if the scene is no longer what was rendered */
  def verify(film: FilmFile, now: FilmHeader): Unit =
    // The samples per pixel may change.
    for difference <- film.header.difference(now.copy(samples = film.header.samples)) do
      val message = s"the scene of `${film.path}` has changed: $difference"
      fail(message, "render it again; or restore what has changed")

  def fail(message: String, help: String = ""): Nothing =
    throw SceneError(Problem.general(message, Option.when(help.nonEmpty)(help)))

  private val Warning = candela.base.Severity.Warning
