package candela

import java.nio.file.{Files, Path}

import scala.collection.mutable
import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

/** Links between the pages of the documentation lead somewhere. */
class MarkdownLinksSuite extends AnyFunSuite:
  private val roots = Vector("docs", "deploy", "scenes", "reference-images", "src/test/resources")

  private val pages: Vector[Path] =
    def in(folder: Path, depth: Int) = Using.resource(Files.walk(folder, depth)): all =>
      all.iterator.asScala.filter(_.toString.endsWith(".md")).toVector
    in(Path.of("."), 1).map(_.normalize) ++
      roots.map(Path.of(_)).filter(Files.isDirectory(_)).flatMap(in(_, 20))

  /** Lines outside code. */
  private def prose(page: Path): Vector[String] =
    val lines = Files.readAllLines(page).asScala.toVector
    val isCode = lines.scanLeft(false)((inside, l) => inside != l.trim.startsWith("```")).tail
    lines.zip(isCode).collect { case (l, false) => l }

  /** Names of the headings of a page, as GitHub makes them. */
  private def anchors(page: Path): Set[String] =
    val seen = mutable.Map.empty[String, Int]
    prose(page).filter(_.matches("#{1,6} .*")).map: heading =>
      val text = heading.dropWhile(_ == '#').trim.replaceAll("\\[([^\\]]*)\\]\\([^)]*\\)", "$1")
      val kept = text.toLowerCase.filter(c => c.isLetterOrDigit || " -_".contains(c))
      val name = kept.replace(' ', '-')
      val count = seen.getOrElse(name, 0)
      seen(name) = count + 1
      if count == 0 then name else s"$name-$count"
    .toSet

  private val byPage = mutable.Map.empty[Path, Set[String]]

  private val Link = """\]\(([^)\s]+)\)""".r

  private def wrong(page: Path, target: String): Option[String] =
    val (name, anchor) = target.span(_ != '#')
    val folder = Option(page.getParent).getOrElse(Path.of(""))
    val file = if name.isEmpty then page else folder.resolve(name).normalize
    def has = byPage.getOrElseUpdate(file, anchors(file))(anchor.drop(1))
    if !Files.exists(file) then Some(s"$page: `$target` is no file")
    else if anchor.nonEmpty && file.toString.endsWith(".md") && !has then
      Some(s"$page: `$target` is no heading")
    else None

  test("relative links of all pages lead to files and headings that are there"):
    assert(pages.size > 20)
    val all =
      for
        page <- pages
        line <- prose(page)
        link <- Link.findAllMatchIn(line.replaceAll("`[^`]*`", "`"))
        target = link.group(1) if !target.matches("[a-z]+:.*")
        problem <- wrong(page, target)
      yield problem
    assert(all.isEmpty, all.mkString("\n", "\n", ""))

  test("the README has at most 1,500 words"):
    assert(Files.readString(Path.of("README.md")).split("\\s+").length <= 1500)
