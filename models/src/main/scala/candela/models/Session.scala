package candela.models

import candela.diagnostics.{Code, Problem, SceneError, Severity, SourcePos, Suggest}
import candela.io.SceneFolder
import candela.scenefile.{
  Declaration, Dialect, Excerpts, Param, Problems, Resolution, SceneDescription
}

import java.nio.file.Path
import java.util.Locale

import scala.collection.mutable

/** State of reading one model: its files, and the problems so far.
  *
  * @param keepGoing  if true, replaces missing files
  * @param resolution of the image, if one is asked for
  * @param label      names the place of a JSON pointer, for messages
  */
private[models] final class Session(
    val file: Path,
    var folder: SceneFolder,
    keepGoing: Boolean,
    resolution: Option[Resolution] = None,
    label: String => String = identity
):
  val members: Members = Members()
  private val collected = Problems()
  private val reported = mutable.LinkedHashSet.empty[Problem]
  private val files = mutable.LinkedHashSet.empty[Path]

  /** All of the model. */
  def position: SourcePos = SourcePos(s"$file", 0, 0)

  /** The place of a JSON pointer. */
  def at(pointer: String): SourcePos = SourcePos(s"$file#${label(pointer)}", 0, 0)

  def report(p: Problem): Unit = if reported.add(p) then collected.add(p)
  def warn(
      at: SourcePos,
      message: String,
      code: Code = Code.Unsupported,
      help: Option[String] = None
  ): Unit = report(Problem.warning(code, at, message, help))
  def error(at: SourcePos, message: String, code: Code = Code.DamagedMesh): Unit =
    report(Problem.error(code, at, message))
  def missing(
      at: SourcePos,
      message: String,
      standIn: String,
      help: Option[String] = None,
      code: Code = Code.NoSuchFile
  ): Unit = report(Problem.missing(code, at, message, standIn, keepGoing).withHelp(help))

  /** The aspect ratio of the image.
    *
    * @param natural that of the model's camera
    */
  def aspect(natural: Double): Double = resolution.fold(natural): asked =>
    val (width, height) = View.size(natural)
    val (askedWidth, askedHeight) = asked.of(width, height)
    askedWidth.toDouble / askedHeight

  /** The scene with the problems of reading it. */
  def finished(scene: SceneDescription): SceneDescription =
    val (errors, warnings) = Excerpts.fill(problems).partition(_.severity == Severity.Error)
    scene.copy(
      warnings = warnings,
      errors = errors,
      sources = file +: filesRead,
      folder = folder
    )

  private def problems: Vector[Problem] =
    for (pointer, name, near) <- members.misspelt do
      warn(at(pointer), s"unknown member `$name`; did you mean `$near`?", Code.UnknownParameter)
    collected.result()

  /** Files read so far, other than the model itself. */
  def filesRead: Vector[Path] = files.toVector
  def note(file: Path): Unit = files += file

  /** As `body`, or None after reporting an error. */
  def attempt[A](body: => A): Option[A] =
    try Some(body)
    catch
      case e: SceneError =>
        e.problems.foreach(report)
        None

  def declare(
      category: String,
      name: String,
      at: SourcePos,
      params: Seq[Param],
      dialect: Option[Dialect] = None
  ): Declaration = Declaration(category, name, params.toVector, at, folder, "srgb", dialect)

/** The members of objects that are asked for, by which those that are misspelt are known. */
private[models] final class Members:
  // As if it were: the reader has no use for it
  private val queriedNames = mutable.HashSet("minFilter")
  private val absent = mutable.LinkedHashMap.empty[String, (String, String)]

  /** @param names of the members of the object at the pointer */
  def query(name: String, names: Iterator[String], pointer: String): Unit =
    queriedNames += name
    for other <- names if other != name && Members.isNear(name, other) do
      absent(Json.memberPointer(pointer, other)) = (other, name)

  /** Pointers to members that nothing asks for, their names, and names that were asked for. */
  def misspelt: Vector[(String, String, String)] =
    absent.iterator.collect {
      case (at, (name, near)) if !queriedNames(name) => (at, name, near)
    }.toVector

private object Members:
  private inline val MaxDistance = 2
  private inline val MinLength = 6

  private def isNear(name: String, other: String): Boolean =
    name.length >= MinLength && Math.abs(name.length - other.length) <= MaxDistance &&
      Suggest.distance(
        name.toLowerCase(Locale.ROOT),
        other.toLowerCase(Locale.ROOT),
        MaxDistance
      ) <= MaxDistance

private[models] object Session:
  def fail(
      at: SourcePos,
      message: String,
      code: Code = Code.DamagedMesh,
      help: Option[String] = None
  ): Nothing = throw SceneError(Problem.error(code, at, message).withHelp(help))

/** What makes models readable that use an extension which is not read. */
private[models] object Remedies:
  def of(extension: String): Option[String] = extension match
    case "KHR_draco_mesh_compression" =>
      Some("export the model without Draco's compression, for example from Blender")
    case "KHR_texture_basisu" =>
      Some("`gltf-transform ktxdecompress` converts the model's images to PNG")
    case "EXT_texture_avif" => Some("`gltf-transform png` converts the model's images to PNG")
    case "MSFT_texture_dds" => Some("convert the model's images to PNG")
    case _ => None
