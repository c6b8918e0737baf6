package candela.job

import candela.base.{Code, Problem, Refusal, SceneError, Suggest}
import candela.build.SceneBuilder
import candela.render.ThreadPool
import candela.scenefile.{Excerpts, SceneDescription}
import candela.settings.{BuildControl, ReadSettings, RenderSettings}

import java.nio.file.{Files, InvalidPathException, Path}

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** Parses and builds a scene. */
abstract class SceneLoader:

  /** @throws SceneError if the scene has errors */
  def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared

  /** The name of a scene's image before it is loaded, if it can be told. */
  def imageName(
      scene: String,
      reading: ReadSettings,
      control: BuildControl
  ): Option[ImageName] = None

/** The image that a scene names.
  *
  * @param file   as its film names it; none: it names none
  * @param folder of images
  */
final case class ImageName(file: Option[String], folder: Path)

object SceneLoader:

  object FromFile extends SceneLoader:
    def load(
        scene: String,
        settings: RenderSettings,
        control: BuildControl
    ): Prepared = refusing:
      val file = existing(scene)
      val started = System.nanoTime
      val description = readable(file, settings.reading, control)
      val seconds = (System.nanoTime - started) * 1e-9
      built(description, settings, control).copy(readSeconds = seconds)

    override def imageName(
        scene: String,
        reading: ReadSettings,
        control: BuildControl
    ): Option[ImageName] =
      // A refusal is told when the scene is loaded
      Try(refusing(named(existing(scene), reading, control))).toOption.flatten

    private def named(
        file: Path,
        reading: ReadSettings,
        control: BuildControl
    ): Option[ImageName] =
      val within = control.limits.folder(file)
      val folder = if within.isConfined then within.path else Path.of("")
      SceneFormat.of(file).imageName(file, within, reading).map(ImageName(_, folder))

  /** A description, ready to be rendered.
    *
    * @throws SceneError if the scene has errors
    */
  def built(
      description: SceneDescription,
      settings: RenderSettings,
      control: BuildControl
  ): Prepared =
    val started = System.nanoTime
    val pool = ThreadPool(control.threads, worksAside = control.isRendered)
    try
      val limited = control.limited
      limited.cache.begin()
      val (built, warnings) = SceneBuilder.build(description, settings, limited, pool)
      val plan = if control.isRendered then built.piloted else built
      val seconds = (System.nanoTime - started) * 1e-9
      val all = description.warnings ++ warnings
      Prepared(description, plan, all, 0, seconds, pool, settings)
    catch
      case e: Throwable =>
        pool.close()
        throw e

  /** Makes an error of what a scene must not do. */
  def refusing[A](body: => A): A = Refusal.told(Excerpts.fill(_))(body)

  /** The readable part of a scene, of any format. */
  def readable(file: Path, reading: ReadSettings, control: BuildControl): SceneDescription =
    try SceneFormat.of(file).read(file, control.limits.folder(file), reading, control.world)
    catch case e: SceneError => throw ForeignAdvice.problem(file).fold(e)(SceneError(_))

  /** The path of an existing scene file. */
  def existing(scene: String): Path =
    val file =
      try Path.of(scene)
      catch
        case e: InvalidPathException =>
          throw SceneError(Problem.general(
            Code.NoSuchScene,
            s"`$scene` is not a valid file name: ${e.getReason}"
          ))
    if Files.isDirectory(file) then
      val help = "name a scene file in it".concat(scenesIn(file).mkString(": ", ", ", ""))
      throw SceneError(Problem.general(Code.NoSuchScene, s"`$scene` is a folder", Some(help)))
    else if !Files.exists(file) then
      val folder = Option(file.toAbsolutePath.getParent)
      val near = folder.flatMap(f => Suggest.nearest(file.getFileName.toString, scenesIn(f)))
      val help = near.map(name => s"did you mean `${file.resolveSibling(name)}`?")
      throw SceneError(Problem.general(Code.NoSuchScene, s"no such scene file: `$scene`", help))
    else file

  private def scenesIn(folder: Path): Vector[String] =
    if !Files.isDirectory(folder) then Vector.empty
    else
      Using.resource(Files.list(folder)): files =>
        val scenes = files.iterator.asScala.filter(SceneFormat.named(_).isDefined)
        scenes.map(_.getFileName.toString).toVector.sorted
