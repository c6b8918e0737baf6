package candela.job

import candela.base.Services
import candela.diagnostics.{Code, Problem, SceneError, Severity}
import candela.io.{FileName, ForeignKind, SceneFolder}
import candela.build.DialectChoice
import candela.build.media.Interiors
import candela.mitsuba.{MitsubaScene, XmlFile}
import candela.scenefile.{Defines, Parser, SceneDescription, TokenDigest}
import candela.settings.{ModelSettings, ModelState, ReadSettings, Sensors}

import java.nio.file.{Files, Path}

import scala.annotation.unused

/** A format of scene files; all are listed in [[SceneFormat.all]].
  *
  * @param name     whose it is
  * @param suffixes of its files, in lower case; those of packed files have `.gz` behind
  */
abstract class SceneFormat(val name: String, val suffixes: Vector[String]):

  /** Whether the dialect may be asked for. */
  def hasDialects: Boolean

  /** Whether files of a kind that is foreign to others are its own. */
  def owns(@unused kind: ForeignKind): Boolean = false

  /** Whether its meshes usually come from other files. */
  def keepsMeshesApart: Boolean

  /** What each image of a file is of, and the number of the first. */
  def worlds: String
  def firstWorld: Int

  /** Whether scenes may have several sensors, or are models. */
  def hasSensors: Boolean = false
  def isModel: Boolean = false

  /** Whether its models are meshes that scenes may name. */
  def isMesh: Boolean = false

  /** Whether it leaves open which axis points up. */
  def leavesUpOpen: Boolean = isMesh

  /** Whether they may have animations and variants of materials. */
  def hasStates: Boolean = false

  /** The readable part of a scene; see [[SceneDescription.errors]].
    *
    * @param world as [[candela.settings.BuildControl]] has it
    * @param text  what is read instead of the file
    * @throws SceneError if nothing is readable, or scenes of the format have not what is asked for
    */
  final def read(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String] = None
  ): SceneDescription =
    checkOptions(file, reading)
    val camera = reading.camera.map(CameraFile.read(_, within, reading))
    val usedByCamera = camera.fold(Set.empty)(_.parameters)
    val scene = firstOf(readable(file, within, reading, world, text, usedByCamera), world)
    camera.fold(Interiors.aroundCamera(scene))(_.applied(scene))

  /** @param usedByCamera names of values that the camera file has, and that the scene needn't */
  protected def readable(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String],
      usedByCamera: Set[String]
  ): SceneDescription

  /** The scene, whose others are left out if none is asked for by its number. */
  private def firstOf(scene: SceneDescription, world: Option[Int]): SceneDescription =
    if !scene.isFollowed || world.isDefined then scene
    else
      val message = s"the file has several $worlds; this is about the first"
      val firstOnly = Problem(Code.SeveralWorlds, Severity.Warning, None, message)
      scene.copy(isFollowed = false, warnings = scene.warnings :+ firstOnly)

  /** Index of the sensor that is asked for, if any is. */
  protected final def sensor(reading: ReadSettings, world: Option[Int]): Option[Int] =
    reading.sensors.map:
      case Sensors.One(index) => index
      case Sensors.All => world.getOrElse(0)

  /** SHA-256 of what a text of this format says. */
  def digest(text: String): String

  /** The image that a scene names, if that can be told before it is read.
    *
    * @return none: it can't; a missing file name: it names none
    */
  def imageName(file: Path, within: SceneFolder, reading: ReadSettings): Option[Option[String]]

  private def checkOptions(file: Path, reading: ReadSettings): Unit =
    def refuse(message: String, help: String) =
      throw SceneError(Problem.general(Code.OptionMisfit, message, Some(help)))
    if !hasSensors && reading.sensors.nonEmpty then
      val help = "--sensor chooses among those of Mitsuba's XML files and cameras of models"
      refuse(s"`$file` has no sensors", help)
    if !isModel && reading.model != ModelSettings() then
      refuse(s"`$file` is no model", "--light, --background, --turntable and --up are for models")
    if !leavesUpOpen && reading.model.up.nonEmpty then
      refuse(s"which axis of `$file` points up is known", s"--up is for other formats than $name")
    if !hasStates && reading.model.state != ModelState() then
      val help =
        "--at, --animation and --variant are for models in glTF and those that Assimp reads"
      refuse(s"`$file` has no animations and no variants", help)
    val several = reading.model.state.times.exists(_.count > 1)
    if several && reading.model.turntable.nonEmpty then
      refuse("a turntable is of one time", "give a single time: --at 1.5")
    if reading.model.hasSeveralImages && reading.sensors.contains(Sensors.All) then
      val option = if several then "--at with several times" else "a turntable"
      refuse(s"$option is of one camera", "render each camera: --sensor 0, --sensor 1 …")
    if reading.model.turntable.nonEmpty && reading.camera.nonEmpty then
      refuse("a turntable moves the camera itself", "render it without --camera")

object SceneFormat:
  /** Those of the core, and those that other modules bring. */
  lazy val all: Vector[SceneFormat] =
    Vector(Pbrt, Mitsuba) ++ Services.installed(classOf[SceneFormat])

  /** The format that a file has by its name, if it is one's. */
  def named(file: Path): Option[SceneFormat] =
    all.find(_.suffixes.contains(FileName.suffix(unpacked(file))))

  /** The name of a scene, without the suffixes of its file. */
  def stem(file: Path): String = FileName.stem(unpacked(file))

  private def unpacked(file: Path): Path =
    if FileName.suffix(file) == "gz" then Path.of(FileName.stem(file)) else file

  /** The format to read a file as: by any other name, it is pbrt's. */
  def of(file: Path): SceneFormat = named(file).getOrElse(Pbrt)

  /** The format of a text: XML can be nothing but Mitsuba's.
    *
    * @param name tells it otherwise
    */
  def of(name: Path, text: String): SceneFormat =
    if text.stripPrefix("\uFEFF").stripLeading.startsWith("<") then Mitsuba else of(name)

  /** `pbrt (.pbrt) or Mitsuba (.xml)` */
  def inWords: String =
    val labels = all.map: f =>
      val ellipsis = if f.suffixes.size > MaxShown then " and others" else ""
      s"${f.name} (${f.suffixes.take(MaxShown).map("." + _).mkString(", ")}$ellipsis)"
    s"${labels.init.mkString(", ")} or ${labels.last}"

  /** Suffixes of a format that messages show, the usual ones. */
  private val MaxShown = 3

  private object Pbrt extends SceneFormat("pbrt", Vector("pbrt")):
    def hasDialects: Boolean = true
    def keepsMeshesApart: Boolean = false
    def worlds: String = "worlds"
    def firstWorld: Int = 1

    protected def readable(
        file: Path,
        within: SceneFolder,
        reading: ReadSettings,
        world: Option[Int],
        text: Option[String],
        usedByCamera: Set[String]
    ): SceneDescription =
      val (dialect, defines) = (reading.dialect, Defines(reading.defines, usedByCamera))
      val (keepGoing, n) = (reading.keepGoing, world.getOrElse(0))
      val read = text match
        case Some(text) =>
          Parser.readableText(file.toString, text, within, dialect, keepGoing, defines, n)
        case None => Parser.readable(file, dialect, keepGoing, n, Some(within), defines)
      DialectChoice.of(read, dialect)

    def digest(text: String): String = TokenDigest.of(text)

    def imageName(file: Path, within: SceneFolder, reading: ReadSettings): Option[Option[String]] =
      if !Files.isRegularFile(file) then None // it can be read once
      else
        Parser.film(
          file,
          reading.dialect,
          within,
          Defines(reading.defines)
        ).flatMap(_.param("filename")) match
          case Some(name) => name.strings.headOption.map(Some(_))
          case None => Some(None)

  private object Mitsuba extends SceneFormat("Mitsuba", Vector("xml")):
    def hasDialects: Boolean = false
    def keepsMeshesApart: Boolean = true
    def worlds: String = "sensors"
    def firstWorld: Int = 0
    override def hasSensors: Boolean = true

    protected def readable(
        file: Path,
        within: SceneFolder,
        reading: ReadSettings,
        world: Option[Int],
        text: Option[String],
        usedByCamera: Set[String]
    ): SceneDescription =
      val scene = MitsubaScene.readable(
        file,
        reading.defines,
        reading.keepGoing,
        Some(within),
        text,
        sensor(reading, world),
        reading.resolution,
        usedByCamera
      )
      scene.copy(isFollowed = scene.isFollowed && reading.sensors.contains(Sensors.All))

    def digest(text: String): String = XmlFile.ofText("", text).digest

    def imageName(file: Path, within: SceneFolder, reading: ReadSettings): Option[Option[String]] =
      Some(None)
