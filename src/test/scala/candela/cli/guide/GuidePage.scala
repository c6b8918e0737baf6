package candela.cli.guide

import java.nio.file.{Files, Path}
import java.nio.file.StandardCopyOption.REPLACE_EXISTING

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** A page of docs/guide, as its tests and its pictures need it. HTML comments, which readers don't
  * see, say what belongs to the block below them:
  *
  *   - `<!-- file: room.pbrt -->`: the block is the file of this name;
  *   - `<!-- not run: REASON -->`: the commands of the block need what tests lack;
  *     `<!-- not run: REASON; a.exr is a copy of b.exr -->` provides what they would leave;
  *   - `<!-- picture: pictures/a.jpg = COMMAND && COMMAND -->`: how the picture is made.
  */
final case class GuidePage(name: String, text: String):
  private val lines = text.linesIterator.toVector

  val words: Int = text.replaceAll("(?s)```.*?```|<!--.*?-->", " ").split("\\s+").count(_.nonEmpty)

  /** Parts between fences: language, the comment in front, first line number, contents. */
  val blocks: Vector[GuidePage.Block] =
    val fences = lines.indices.filter(i => lines(i).startsWith("```")).toVector
    fences.grouped(2).toVector.map: pair =>
      val (start, end) = (pair(0), pair(1))
      val above = lines.take(start).reverseIterator.find(_.nonEmpty).getOrElse("")
      val comment = above match
        case s"<!-- $inside -->" => inside
        case _ => ""
      GuidePage.Block(
        lines(start).drop(3),
        comment,
        start + 1,
        lines.slice(start + 1, end).mkString("", "\n", "\n")
      )

  val files: Vector[(String, String)] =
    blocks.collect { case GuidePage.Block(_, s"file: $file", _, contents) => file -> contents }

  /** Picture and the commands that make it. */
  val pictures: Vector[(String, Vector[String])] = lines.collect:
    case s"<!-- picture: $file = $commands -->" => file -> commands.split(" && ").toVector

object GuidePage:
  val Folder: Path = Path.of("docs", "guide")

  def all: Vector[GuidePage] =
    val files = Using.resource(Files.list(Folder))(_.iterator.asScala.toVector)
    files
      .filter(_.toString.endsWith(".md"))
      .sortBy(_.getFileName.toString)
      .map(f => GuidePage(f.getFileName.toString, Files.readString(f)))

  final case class Block(language: String, comment: String, line: Int, contents: String):
    /** Continued lines are one command. */
    def commands: Vector[String] =
      contents.replace("\\\n", " ").linesIterator.map(_.trim).filter(_.nonEmpty).toVector

/** A folder with the guide's files, in which its commands run within this process.
  *
  * @param small   for tests: renders few pixels with few samples
  */
final class GuideRoom(folder: Path, pages: Vector[GuidePage], small: Boolean):
  for (name, contents) <- pages.flatMap(_.files) do
    val text = if small then GuideRoom.smaller(contents) else contents
    val _ = Files.writeString(folder.resolve(name), text)

  def path(file: String): Path = folder.resolve(file)

  def copy(from: String, to: String): Unit =
    val _ = Files.copy(path(from), path(to), REPLACE_EXISTING)

  /** The words behind `candela`, with files in this folder. */
  def arguments(command: String): Vector[String] =
    val words = command.split("\\s+").toVector.map(_.stripPrefix("'").stripSuffix("'"))
    val samples = words.zip("" +: words).map: (word, before) =>
      if !small then word
      else
        before match
          case "--spp" => (word.toInt / 16).max(1).min(8).toString
          case "--error" => "0.5"
          case "--time" => "1s"
          case _ => word
    samples.map(_.split(",").map(placed).mkString(",")).drop(1)

  private def placed(word: String): String =
    if GuideRoom.isFile(word) then path(word).toString else word

object GuideRoom:
  private val suffixes =
    "pbrt xml exr npz png jpg pfm film html json csv svg conf ply".split(" ").toVector

  private def isFile(word: String): Boolean =
    word.matches("[A-Za-z0-9][\\w.%-]*") && suffixes.exists(s => word.endsWith(s".$s"))

  /** A tenth of the width and height, few samples, photons and chains. */
  private def smaller(scene: String): String =
    def limit(text: String, name: String, f: Int => Int): String =
      s"(\"integer $name\" )(\\d+)".r
        .replaceAllIn(text, m => s"${m.group(1)}${f(m.group(2).toInt)}")
    val pixels = Vector("xresolution", "yresolution").foldLeft(scene)(limit(_, _, _ / 10))
    val counts = Vector("pixelsamples" -> 4, "mutationsperpixel" -> 8, "photonsperiteration" -> 500)
      .foldLeft(pixels) { case (text, (name, most)) => limit(text, name, _.min(most)) }
    counts
      .replace("\"mlt\"", "\"mlt\" \"integer bootstrapsamples\" 2000 \"integer chains\" 10")
      .replaceAll("(name=\"(?:width|height)\" value=\"\\d+)0\"", "$1\"")
      .replaceAll("name=\"sample_count\" value=\"\\d+\"", "name=\"sample_count\" value=\"4\"")
