package candela.cli

import candela.base.{Problem, Refusal, SceneError, Severity, Suggest}
import candela.build.{BuildControl, DialectChoice, RenderRegion, SceneBuilder}
import candela.mitsuba.MitsubaScene
import candela.render.{RenderPlan, ThreadPool}
import candela.scenefile.{Excerpts, Parser, SceneDescription}

import java.nio.file.{Files, InvalidPathException, Path}

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** A scene ready to render, its description, and the load times.
  *
  * @param warnings of parser and builder
  */
final case class LoadedScene(
    description: SceneDescription,
    plan: RenderPlan,
    warnings: Vector[Problem],
    parseSeconds: Double,
    buildSeconds: Double
):
  /** Number of missing items replaced by placeholders. */
  def standIns: Int = warnings.distinct.count(_.standIn.nonEmpty)

/** Parses and builds a scene. */
abstract class SceneLoader:

  /** @throws SceneError if the scene has errors */
  def load(scene: String, options: Options): LoadedScene

  /** The images of a scene that is not loaded yet, if they can be told. */
  def images(scene: String, options: Options): Option[OutputFiles] = None

object SceneLoader:

  object FromFile extends SceneLoader:
    def load(scene: String, options: Options): LoadedScene = refusing:
      val file = existing(scene)
      val started = System.nanoTime
      val description = readable(file, options)
      val parsed = System.nanoTime
      val (plan, warnings) = build(description, options)
      val built = System.nanoTime
      val all = description.warnings ++ warnings
      LoadedScene(description, plan, all, (parsed - started) * 1e-9, (built - parsed) * 1e-9)

    override def images(scene: String, options: Options): Option[OutputFiles] =
      // A refusal is told when the scene is loaded
      Try(refusing(named(scene, existing(scene), options))).toOption.flatten

    private def named(scene: String, file: Path, options: Options): Option[OutputFiles] =
      val within = options.limits.folder(file)
      val folder = if within.isConfined then within.path else Path.of("")
      if MitsubaScene.isNamed(file) then Some(OutputFiles.ofName(scene, folder))
      else if !Files.isRegularFile(file) then None // it can be read once
      else
        Parser.film(
          file,
          options.settings.reading.dialect,
          within
        ).flatMap(_.param("filename")) match
          case Some(name) => name.strings.headOption.map(OutputFiles.ofFilm(_, folder))
          case None => Some(OutputFiles.ofName(scene, folder))

  /** Makes an error of what a scene must not do. */
  def refusing[A](body: => A): A = Refusal.told(Excerpts.fill(_))(body)

  /** The readable part of a scene: XML is Mitsuba's, everything else pbrt's. */
  def readable(file: Path, options: Options): SceneDescription =
    val folder = options.limits.folder(file)
    val reading = options.settings.reading
    // What is not to be read is not looked at either
    if folder.isConfined then folder.scene(file): Unit
    for problem <- ForeignAdvice.problem(file) do throw SceneError(problem)
    if MitsubaScene.isNamed(file) then
      MitsubaScene.readable(file, reading.defines, reading.keepGoing, Some(folder))
    else if reading.defines.nonEmpty then
      val help = "-D sets parameters of Mitsuba's XML files"
      throw SceneError(Problem.general(s"`$file` has no parameters", Some(help)))
    else
      val within = Some(folder)
      val read = Parser.readable(file, reading.dialect, reading.keepGoing, options.world, within)
      val scene = DialectChoice.of(read, reading.dialect)
      if !scene.isFollowed || options.command == Command.Render then scene
      else scene.copy(warnings = scene.warnings :+ Problem(Severity.Warning, None, FirstOnly))

  private val FirstOnly = "the file has several worlds; this is about the first"

  private def build(d: SceneDescription, o: Options): (RenderPlan, Vector[Problem]) =
    // A traced pixel is one of the whole image
    val region = if o.debug then RenderRegion.Whole else o.settings.region
    val shown = if o.pixelMaterial.isEmpty then Vector.empty else PixelMaterial.Layers
    val settings = o.settings.copy(region = region, layers = (o.settings.layers ++ shown).distinct)
    val pool = ThreadPool(o.threadCount, worksAside = o.command != Command.Check)
    SceneBuilder.build(d, settings, BuildControl(pool, o.taken, o.footprint))

  /** The path of an existing scene file. */
  def existing(scene: String): Path =
    val file =
      try Path.of(scene)
      catch
        case e: InvalidPathException =>
          throw SceneError(Problem.general(s"`$scene` is not a valid file name: ${e.getReason}"))
    if Files.isDirectory(file) then
      val help = "name a scene file in it".concat(scenesIn(file).mkString(": ", ", ", ""))
      throw SceneError(Problem.general(s"`$scene` is a folder", Some(help)))
    else if !Files.exists(file) then
      val folder = Option(file.toAbsolutePath.getParent)
      val near = folder.flatMap(f => Suggest.nearest(file.getFileName.toString, scenesIn(f)))
      val help = near.map(name => s"did you mean `${file.resolveSibling(name)}`?")
      throw SceneError(Problem.general(s"no such scene file: `$scene`", help))
    else file

  private def scenesIn(folder: Path): Vector[String] =
    if !Files.isDirectory(folder) then Vector.empty
    else
      Using.resource(Files.list(folder)): files =>
        val names = files.iterator.asScala.map(_.getFileName.toString)
        names.filter(n => n.endsWith(".pbrt") || n.endsWith(".xml")).toVector.sorted
