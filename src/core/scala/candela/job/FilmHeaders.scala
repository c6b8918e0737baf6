package candela.job

import candela.base.Version
import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{InputFile, Sha256}
import candela.film.PixelBounds
import candela.render.{RenderPlan, Shard}
import candela.render.storage.FilmHeader
import candela.scenefile.{SceneDescription, SceneFiles}
import candela.settings.{RenderGoal, RenderSettings, SettingsCodec}

import java.nio.file.{Files, Path}

import scala.util.Try

/** Describes renderings for their film files. */
object FilmHeaders:

  /** @param scene as it was named
    * @param film  the film file
    * @param files image files to write
    */
  def of(
      settings: RenderSettings,
      scene: String,
      prepared: Prepared,
      film: Path,
      files: Vector[Path] = Vector.empty,
      shard: Shard = Shard.Whole
  ): FilmHeader =
    val plan = prepared.plan
    FilmHeader(
      Version.build,
      scene,
      relative(film.toAbsolutePath.getParent, workingFolder).toString,
      SettingsCodec.identity(settings),
      files.map(_.toString),
      digests(prepared.description) ++ names(plan) ++
        Option.when(plan.adaptive.isDefined)(Adaptive -> Sha256.of(Adaptive)),
      size(plan),
      plan.sampler.samplesPerPixel,
      done = 0,
      plan.differentialScale,
      Set(shard.index),
      shard.count,
      text = prepared.description.text.map(_.content)
    )

  /** The settings of a saved rendering, which keeps its choices with any goal.
    *
    * @throws SceneError if the film is forged
    */
  def settings(header: FilmHeader): RenderSettings =
    SettingsCodec.settings(header.words) match
      case Right(saved) =>
        // With a number of samples, a scene's sampler is not adaptive
        saved.chosen.copy(samples = Option.unless(isAdaptive(header))(header.samples))
      case Left(why) =>
        val message = s"the film of `${header.scene}` has invalid settings: $why"
        throw SceneError(Problem.general(Code.OtherRendering, message))

  /** Whether samples themselves decide how many a pixel has. */
  def isAdaptive(header: FilmHeader): Boolean = header.files.exists(_._1 == Adaptive)

  /** Stands among the files, as it is part of a rendering's identity. */
  private val Adaptive = "adaptive sampling"

  private def workingFolder: Path = Path.of("").toAbsolutePath

  /** `to` relative to `from`, or as it is on another drive. */
  private def relative(from: Path, to: Path): Path = Try(from.relativize(to)).getOrElse(to)

  private def size(plan: RenderPlan): String =
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    s"${plan.width}x${plan.height}, pixels $x0 to $x1, $y0 to $y1, " +
      (if plan.sharesSamples then "splatted" else "one pixel each")

  /** Name, among a film's digests, of that of statements that a program has made. */
  val Statements = "statements"

  /** Whether a program has made the scene, or edited it. */
  def isMadeInCode(header: FilmHeader): Boolean = header.files.exists(_._1 == Statements)

  /** SHA-256 of the scene's files, as they were read, by their names relative to the scene's
    * folder, and of what is in no file. Those of scene files are of what they say.
    */
  private def digests(scene: SceneDescription): Vector[(String, String)] =
    val files = SceneFiles.of(scene).map(_.toAbsolutePath.normalize)
    val folder = scene.sources.headOption.map(_.toAbsolutePath.normalize.getParent)
    val filed = files.map: file =>
      folder.fold(file)(relative(_, file)).toString ->
        scene.folder.reads.digest(file).getOrElse(digest(file))
    filed ++ scene.unfiled

  /** SHA-256 of names that line numbers are part of, if layers or light groups depend on them:
    * comments, which have no part in the digest of a file, change these.
    */
  private def names(plan: RenderPlan): Option[(String, String)] =
    val names = plan.layers.iterator.flatMap: l =>
      l.names.objects.iterator ++ l.names.materials ++ l.division.iterator.flatMap(_.describe)
    Option.when(names.nonEmpty)("names with line numbers" -> Sha256.ofLines(names))

  private def digest(file: Path): String =
    for why <- InputFile.obstacle(file) do
      val message = s"a saved rendering must recognise `$file` later, but can't: $why"
      val help = Some("write the scene to a file first")
      throw SceneError(Problem.general(Code.Unreadable, message, help))
    Sha256.ofAll(Files.newInputStream(file))

  /** The digest of a whole rendering, which may have ended by a goal. */
  def digest(header: FilmHeader, goal: RenderGoal): String =
    val ends = goal.time.map("time" -> _) ++ goal.error.map("error" -> _)
    val facts =
      Vector(header.version, header.size, header.samples) ++ header.words ++ header.files ++ ends
    Sha256.of(facts.mkString("\n"))
