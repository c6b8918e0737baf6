package candela.cli.files

import candela.diagnostics.{Code, Problem, SceneError, Severity}
import candela.io.FileName
import candela.aov.{ImageLayer, Layer, NamedLayer, StrategyLayer}
import candela.build.film.FilmRecipe
import candela.cli.options.{FilmOptions, Words}
import candela.image.{Contents, ImageError, OutputFormat}
import candela.job.{ImageName, Prepared, SceneFormat, StrategyFiles}
import candela.render.RenderPlan

import java.io.IOException
import java.nio.file.{Files, InvalidPathException, Path}

/** Output files of an image, one per format, and the warnings about them. */
final case class OutputFiles(paths: Vector[Path], warnings: Vector[Problem]):

  /** Verifies before rendering that the files can be written.
    *
    * @throws SceneError if one can't
    */
  def check(): Unit =
    val problems = paths.flatMap(OutputFiles.problem)
    if problems.nonEmpty then throw SceneError(problems)

  /** Verifies that they can be written, and are no inputs.
    *
    * @throws SceneError if one can't
    */
  def check(inputs: Vector[String], kind: String): Unit =
    check()
    val register = FileRegister()
    register.read(inputs.map(OutputFiles.path))
    register.write(Output(paths, kind, inputs.headOption.mkString))

  /** Leaves out a preview that would overwrite a file that was read, or go to a pipe: nobody asked
    * for it.
    */
  def excluding(isRead: Path => Boolean): OutputFiles =
    def isPipe(path: Path) = Files.exists(path) && !Files.isRegularFile(path)
    val (lost, kept) = paths.drop(1).partition(path => isRead(path) || isPipe(path))
    val notices = lost.map: path =>
      val reason = if isRead(path) then "an input file" else "not a regular file"
      Problem(
        Code.OutputConflict,
        Severity.Warning,
        None,
        s"no preview is written: `$path` is $reason"
      )
    OutputFiles(paths.take(1) ++ kept, warnings ++ notices)

  /** Those of the strategies that are told apart. */
  def strategies(plan: RenderPlan): Vector[Path] =
    paths.headOption.toVector.flatMap(StrategyFiles(plan).beside)

  def withStrategies(plan: RenderPlan): OutputFiles =
    copy(paths = (paths ++ strategies(plan)).distinct)

  /** @throws SceneError if no file can store alpha */
  def checkAlpha(): Unit =
    val fitting = OutputFormat.all.filter(f => f.keepsAlpha || f.contents == Contents.Channels)
    if !paths.flatMap(OutputFormat.of).exists(fitting.contains) then
      val message = s"alpha needs ${OutputFormat.inWords(fitting)} output, found `${paths.head}`"
      throw SceneError(Problem.general(Code.UnknownFormat, message))

  /** @throws SceneError if no file can store AOVs */
  def checkLayers(): Unit =
    if !paths.flatMap(OutputFormat.of).exists(_.contents == Contents.Channels) then
      val suffixes = OutputFormat.listed(Contents.Channels)
      val message = s"AOVs need $suffixes output, found `${paths.head}`"
      val help = s"--outfile FILE.${OutputFormat.default.suffix} stores them"
      throw SceneError(Problem.general(Code.UnknownFormat, message, Some(help)))

object OutputFiles:

  /** Writes every file that can be written; the others, and what is wrong with each. */
  def failures(paths: Vector[Path])(write: Path => Unit): Vector[(Path, Problem)] =
    def failed(path: Path, code: Code, e: Exception) =
      Some(path -> Problem.general(code, e.getMessage))
    paths.flatMap: path =>
      try
        write(path)
        None
      catch
        case e: ImageError => failed(path, e.code, e)
        case e: IOException => failed(path, Code.Unwritable, e)

  /** Writes every file that can be written.
    *
    * @throws SceneError if some can't be
    */
  def writeAll(paths: Vector[Path])(write: Path => Unit): Unit =
    val problems = failures(paths)(write).map(_._2)
    if problems.nonEmpty then throw SceneError(problems)

  /** Whether a file must store layers; alpha, what scenes name themselves, those that only guide
    * the denoiser, and those that have their own files need none.
    */
  def needLayers(plan: RenderPlan, denoises: Boolean): Boolean =
    val guides = Layer.Alpha +: (if denoises then Layer.denoising else Vector.empty)
    def isIdle(layer: ImageLayer) = layer match
      case _: NamedLayer | _: StrategyLayer => true
      case other => guides.contains(other)
    plan.layers.exists(!_.layers.forall(isIdle)) || plan.development.bands.nonEmpty

  /** Exactly the requested images. */
  def requested(names: Vector[String]): OutputFiles =
    ofImages(names.filterNot(FilmOptions.isFilm))

  /** For commands that write no films. */
  def ofImages(names: Vector[String]): OutputFiles =
    OutputFiles(names.map(path).distinctBy(_.toAbsolutePath.normalize), Vector.empty)

  /** The file named by the scene's Film, or else after the scene: all scenes without a name would
    * write pbrt's `pbrt.exr`.
    */
  def ofScene(scene: String, loaded: Prepared): OutputFiles =
    val description = loaded.description
    // A confined scene writes where it reads
    val folder = if description.folder.isConfined then description.folder.path else Path.of("")
    val isNamed = description.film.exists(_.params.exists(_.name == "filename"))
    if isNamed || loaded.plan.filename != FilmRecipe.DefaultFile then
      val problem = FilmName.problem(description)
      for p <- problem if p.severity == Severity.Error do throw SceneError(p)
      val files = ofFilm(loaded.plan.filename, folder)
      files.copy(warnings = problem.toVector ++ files.warnings)
    else ofName(scene, folder)

  /** Of a scene that is not loaded yet. */
  def named(scene: String, image: ImageName): OutputFiles =
    image.file.fold(ofName(scene, image.folder))(ofFilm(_, image.folder))

  /** Files named after the scene, in a folder. */
  def ofName(scene: String, folder: Path): OutputFiles =
    val file = path(scene).getFileName
    val stem = if FileName.suffix(file) == "gz" then Path.of(FileName.stem(file)) else file
    ofFilm(s"${FileName.stem(stem)}.${OutputFormat.default.suffix}", folder)

  /** The file named by the scene's Film, relative to a folder, plus a preview if its format can't
    * be displayed. Formats that Candela doesn't write (pbrt has more) are replaced by
    * the default.
    */
  def ofFilm(filename: String, folder: Path = Path.of("")): OutputFiles =
    val named = folder.resolve(path(filename))
    OutputFormat.of(named) match
      case Some(format) if format.contents == Contents.Display =>
        OutputFiles(Vector(named), Vector.empty)
      case Some(_) => OutputFiles(withPreview(named), Vector.empty)
      case None =>
        val written = FileName.withSuffix(named, OutputFormat.default.suffix)
        val message = s"`$filename` is not ${OutputFormat.listed()}; " +
          s"writing `$written`"
        OutputFiles(
          withPreview(written),
          Vector(Problem(Code.ImageName, Severity.Warning, None, message))
        )

  private def withPreview(path: Path): Vector[Path] =
    Vector(path, FileName.withSuffix(path, OutputFormat.preview.suffix))

  /** What an image says of those that it was made of: it is the same, wherever they are. */
  def sources(paths: Vector[Path]): (String, String) =
    (if paths.size == 1 then "image" else "images") -> paths.map(_.getFileName).mkString(", ")

  /** `name` as the path of a text, which must not replace an image, a film or another scene.
    *
    * @param purpose   who writes what
    * @param isForeign whether scenes of the format are not such texts
    */
  def ofText(name: String, purpose: String, suffix: String)(
      isForeign: SceneFormat => Boolean
  ): Path =
    val file = path(name)
    val ending = FileName.suffix(file)
    val kind =
      if FilmOptions.isFilm(name) then Some("a film file")
      else if Words.imageSuffixes.contains(ending) then Some("an image")
      else SceneFormat.named(file).filter(isForeign).map(f => s"a file of ${f.name}")
    for k <- kind do
      val message = s"`$file` is the name of $k; $purpose"
      throw SceneError(Problem.general(Code.UnknownFormat, message, Some(s"name it .$suffix")))
    file

  /** `name` as a path. */
  def path(name: String): Path =
    try Path.of(name)
    catch
      case e: InvalidPathException =>
        throw SceneError(Problem.general(
          Code.Unwritable,
          s"`$name` is not a valid file name: ${e.getReason}"
        ))

  private def problem(path: Path): Option[Problem] =
    if OutputFormat.of(path).isEmpty then
      val help = s"supported formats: ${OutputFormat.listed()}"
      Some(Problem.general(Code.UnknownFormat, s"can't write `$path`", Some(help)))
    else FileRegister.obstacle(path)
