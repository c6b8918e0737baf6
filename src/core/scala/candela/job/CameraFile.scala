package candela.job

import candela.build.media.Interiors
import candela.diagnostics.{Code, Problem, SceneError, SourcePos}
import candela.io.{InputFile, IoReason, SceneFolder}
import candela.mitsuba.SensorFile
import candela.scenefile.{CameraStatements, Defines, Dialect, Resolution, SceneDescription, Source}
import candela.settings.ReadSettings

import java.io.IOException
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, InvalidPathException, Path}

import scala.util.Using

/** A file with a camera in place of a scene's own.
  *
  * @param parameters names of the user's values that it has
  * @param view       the scene with its camera; throws [[SceneError]] if the text has errors
  */
final class CameraFile private (
    name: String,
    file: Path,
    val parameters: Set[String],
    view: SceneDescription => SceneDescription
):
  /** The scene with this camera, and with the medium around it.
    *
    * @throws SceneError if the file is wrong
    */
  def applied(scene: SceneDescription): SceneDescription =
    val viewed = view(scene)
    viewed.copy(
      sources = viewed.sources :+ file,
      warnings = viewed.warnings ++ CameraFile.mirroring(scene, viewed, name)
    )

/** Reads them: `LookAt` and `Camera` statements for scenes of every format, or the `<sensor>` of
  * Mitsuba's.
  */
object CameraFile:

  /** The file that the user has named.
    *
    * @throws SceneError if it is missing or wrong
    */
  def read(name: String, within: SceneFolder, reading: ReadSettings): CameraFile =
    val file = existing(name)
    // The user has named it, so an untrusted scene's may be anywhere
    val folder = SceneFolder.of(file, allowance = within.allowance)
    val text = textOf(name, folder.scene(file))
    val unmarked = text.stripPrefix("\uFEFF")
    if unmarked.stripLeading.startsWith("<") then
      val sensor = SensorFile(file, folder, unmarked, reading.defines)
      new CameraFile(name, file, sensor.parameters, ofSensor(_, file, sensor, reading))
    else
      val defines = Defines(reading.defines)
      val source = defines.substitute(Source.fromText(name, text))
      new CameraFile(name, file, defines.usedNames, ofStatements(_, source, folder))

  /** If pbrt's left-handed camera stands in a right-handed scene, or the reverse. */
  private def mirroring(
      scene: SceneDescription,
      viewed: SceneDescription,
      name: String
  ): Option[Problem] =
    def isMirrored(s: SceneDescription) = s.worldToCamera.start.swapsHandedness
    Option.when(scene.camera.isDefined && isMirrored(scene) != isMirrored(viewed)):
      Problem.warning(
        Code.OptionMisfit,
        SourcePos(name, 1, 1),
        "this camera shows the scene mirrored, unlike the scene's own",
        Some("begin the file with `Scale -1 1 1`")
      )

  /** The scene with the camera of statements.
    *
    * @param name of the text in messages
    * @throws SceneError if the text has errors
    */
  def ofText(scene: SceneDescription, name: String, text: String): SceneDescription =
    ofStatements(scene, Source.fromText(name, text), scene.folder)

  private def ofStatements(
      scene: SceneDescription,
      source: Source,
      folder: SceneFolder
  ): SceneDescription =
    CameraStatements.applied(scene, source, folder, Interiors.aroundCamera)

  private def existing(name: String): Path =
    val file =
      try Path.of(name)
      catch case e: InvalidPathException => fail(name, e.getReason)
    if !Files.exists(file) then
      fail(name, "no such file", SceneFolder.suggestionFor(file))
    if Files.isDirectory(file) then fail(name, "it is a folder")
    file

  private def textOf(name: String, file: InputFile): String =
    try
      val bytes = Using.resource(file.stream())(_.readNBytes(MaxBytes + 1))
      if bytes.length > MaxBytes then fail(name, s"it is larger than $MaxBytes bytes")
      String(bytes, UTF_8)
    catch case e: IOException => fail(name, IoReason(e))

  private def fail(name: String, why: String, help: Option[String] = None): Nothing =
    val message = s"can't read the camera file `$name`: $why"
    throw SceneError(Problem.general(Code.NoSuchFile, message, help))

  private val MaxBytes = 1 << 20

  /** Of a `<sensor>`, whose film has the size of the scene's. */
  private def ofSensor(
      scene: SceneDescription,
      file: Path,
      sensor: SensorFile,
      reading: ReadSettings
  ): SceneDescription =
    if scene.dialect != Dialect.Mitsuba then
      throw SceneError(Problem.error(
        Code.OtherDialect,
        SourcePos(file.toString, 1, 1),
        "a <sensor> is a camera of Mitsuba's scenes, and this scene is of another format",
        Some("write `LookAt` and `Camera`")
      ))
    def size(name: String) = scene.film.flatMap(_.param(name)).flatMap(_.ints.headOption)
    val resolution = size("xresolution").zip(size("yresolution")).map: (width, height) =>
      val (seenWidth, seenHeight) =
        reading.resolution.fold((width, height))(_.of(width, height))
      Resolution.Size(seenWidth, seenHeight)
    val viewed = sensor.view(reading.keepGoing, resolution)
    if viewed.errors.nonEmpty then throw SceneError(viewed.errors)
    scene.copy(
      camera = viewed.camera,
      worldToCamera = viewed.worldToCamera,
      warnings = scene.warnings ++ viewed.warnings
    )
