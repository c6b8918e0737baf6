package candela.mitsuba

import candela.base.{Problem, SceneError, SourcePos, Suggest}
import candela.scenefile.{Declaration, Dialect, Param, Problems}

import java.nio.file.{Files, InvalidPathException, Path}

import scala.collection.mutable

/** State of translating one scene: its objects by id, the folders of its files, and the problems
  * found so far.
  */
final class Session(expanded: Expanded, folder: Path, keepGoing: Boolean):
  private val problems = Problems()
  private val files = mutable.LinkedHashSet.empty[Path]
  private val seen = mutable.LinkedHashSet.empty[Problem]

  /** Objects of the scene, in order. */
  val objects: Vector[Property] =
    val values = Values(spectrum, report)
    expanded.elements.flatMap: e =>
      if e.tag == "ref" then None
      else values.plugin(e).map(p => Property(e("name").getOrElse(""), Value.Nested(p), e.at))

  private val byId: Map[String, Plugin] =
    val all = mutable.HashMap.empty[String, Plugin]
    def collect(p: Plugin): Unit =
      for id <- p.id do
        if all.contains(id) then
          error(p.at, s"the id `$id` is repeated; the first is at ${all(id).at}")
        else all(id) = p
      p.properties.map(_.value).foreach:
        case Value.Nested(inner) => collect(inner)
        case _ => ()
    objects.map(_.value).foreach:
      case Value.Nested(p) => collect(p)
      case _ => ()
    all.toMap

  def report(p: Problem): Unit = if seen.add(p) then problems.add(p)
  def warn(at: SourcePos, message: String, help: Option[String] = None): Unit =
    report(Problem.warning(at, message, help))
  def error(at: SourcePos, message: String, help: Option[String] = None): Unit =
    report(Problem.error(at, message, help))
  def missing(at: SourcePos, message: String, standIn: String, help: Option[String]): Unit =
    report(Problem.missing(at, message, standIn, keepGoing, help))

  def found: Vector[Problem] = problems.result()

  /** Files read so far, other than XML. */
  def read: Vector[Path] = files.toVector

  /** The object with this id, if there is one. */
  def known(id: String): Option[Plugin] =
    byId.get(id).orElse(expanded.aliases.get(id).flatMap(byId.get))

  def plugin(id: String, at: SourcePos): Option[Plugin] =
    val there = known(id)
    if there.isEmpty then
      error(
        at,
        s"no object has the id `$id`",
        Suggest.help(id, byId.keySet ++ expanded.aliases.keySet)
      )
    there

  /** Path of a file, in the first folder that has it. */
  def find(name: String): Path =
    val plain = name.replace('\\', '/')
    expanded.folders.map(_.resolve(plain)).find(Files.isRegularFile(_))
      .getOrElse(folder.resolve(plain))

  /** Path of a file of numbers, which becomes part of the scene if it exists. */
  def spectrum(name: String): Path =
    val path = find(name)
    if Files.isRegularFile(path) then files += path
    path

  /** An existing file, which becomes part of the scene. */
  def file(name: String, at: SourcePos, standIn: String): Option[Path] =
    try
      val path = find(name)
      val exists = Files.isRegularFile(path)
      if exists then files += path
      else missing(at, s"no such file: `$name`", standIn, Suggest.file(path))
      Option.when(exists)(path)
    catch
      case _: InvalidPathException =>
        missing(at, s"`$name` is not a valid file name", standIn, None)
        None

  /** The name of a file for a parameter, relative to the folder of the scene. */
  def named(path: Path): String =
    try folder.toAbsolutePath.relativize(path.toAbsolutePath).toString.replace('\\', '/')
    catch case _: IllegalArgumentException => path.toString

  def declare(
      category: String,
      name: String,
      at: SourcePos,
      params: Seq[Param],
      dialect: Option[Dialect] = None
  ): Declaration = Declaration(category, name, params.toVector, at, folder, "srgb", dialect)

  /** Runs `body` on the properties of an object, then reports those that it did not ask for. */
  def of[A](p: Plugin)(body: Asked => A): A =
    val asked = Asked(p, this)
    val result = body(asked)
    asked.finish()
    result

  /** As `body`, or None after reporting an error. */
  def attempt[A](body: => A): Option[A] =
    try Some(body)
    catch
      case e: SceneError =>
        e.problems.foreach(report)
        None

object Session:
  /** References through references, at most. */
  val Deepest = 50
