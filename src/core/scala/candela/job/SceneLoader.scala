package candela.job

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import candela.settings.{BuildControl, ReadSettings, RenderSettings}

import java.nio.file.{Files, InvalidPathException, Path}

import scala.annotation.unused
import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** Parses and builds a scene. */
abstract class SceneLoader:

  /** @throws SceneError if the scene has errors */
  def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared

  /** @throws SceneError if it is known that there is no such scene */
  def checkExists(@unused scene: String): Unit = ()

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
    override def checkExists(scene: String): Unit = SceneName.existing(scene): Unit

    def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
      Render.prepare(scene, settings, control)

    override def imageName(
        scene: String,
        reading: ReadSettings,
        control: BuildControl
    ): Option[ImageName] =
      // A refusal is told when the scene is loaded
      val name = Try(Render.withinLimits()(imageName(SceneName.existing(scene), reading, control)))
      name.toOption.flatten

    private def imageName(
        file: Path,
        reading: ReadSettings,
        control: BuildControl
    ): Option[ImageName] =
      val sceneFolder = control.limits.folder(file)
      val folder = if sceneFolder.isConfined then sceneFolder.path else Path.of("")
      SceneFormat.of(file).imageName(file, sceneFolder, reading).map(ImageName(_, folder))

  /** Loads a scene that is no file.
    *
    * @param name  of the scene, in whose folder the files are that its text names
    * @param files loads all others
    */
  final class OfText(name: String, text: String, files: SceneLoader) extends SceneLoader:
    override def checkExists(scene: String): Unit = if scene != name then files.checkExists(scene)

    def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
      if scene != name then files.load(scene, settings, control)
      else
        val description = Render.readText(Path.of(name), text, settings.reading, control)
        Render.build(description, settings, control)

/** Names of scene files. */
object SceneName:

  /** The path of an existing scene file. */
  def existing(scene: String): Path =
    def fail(message: String, help: Option[String] = None) =
      throw SceneError(Problem.general(Code.NoSuchScene, message, help))
    if scene.isEmpty then fail("the name of the scene is empty")
    val file =
      try Path.of(scene)
      catch
        case e: InvalidPathException =>
          fail(s"`$scene` is not a valid file name: ${e.getReason}")
    if Files.isDirectory(file) then
      val scenes = scenesIn(file)
      val help =
        Option.when(scenes.nonEmpty)(scenes.mkString("name a scene file in it: ", ", ", ""))
      fail(s"`$scene` is a folder", help)
    else if !Files.exists(file) then
      val folder = Option(file.toAbsolutePath.getParent)
      val nearest = folder.flatMap(f => Suggest.nearest(file.getFileName.toString, scenesIn(f)))
      val help = nearest.map(name => s"did you mean `${file.resolveSibling(name)}`?")
      fail(s"no such scene file: `$scene`", help)
    else file

  private def scenesIn(folder: Path): Vector[String] =
    if !Files.isDirectory(folder) then Vector.empty
    else
      Using.resource(Files.list(folder)): files =>
        val scenes = files.iterator.asScala.filter(SceneFormat.named(_).isDefined)
        scenes.map(_.getFileName.toString).toVector.sorted
