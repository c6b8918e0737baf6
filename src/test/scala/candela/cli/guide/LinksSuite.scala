package candela.cli.guide

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

/** The links between pages, and to files and folders, lead somewhere. */
class LinksSuite extends AnyFunSuite:
  private val folders = Vector("docs", "scenes", "reference-images", "deploy")

  private def pages: Vector[Path] =
    def markdown(files: java.util.stream.Stream[Path]) =
      Using.resource(files)(_.iterator.asScala.filter(_.toString.endsWith(".md")).toVector)
    markdown(Files.list(Path.of(""))) ++
      folders.flatMap(folder => markdown(Files.walk(Path.of(folder)))).sorted

  private val link = "\\]\\(([^)\\s]+)\\)".r

  /** Anchors as GitHub makes them of headings. */
  private def anchors(text: String): Set[String] =
    val headings = text.replaceAll("(?s)```.*?```", "").linesIterator.collect:
      case line if line.startsWith("#") =>
        val title = line.dropWhile(_ == '#').trim.replaceAll("\\[([^\\]]*)\\]\\([^)]*\\)", "$1")
        title.toLowerCase.filter(c => c.isLetterOrDigit || " -_".contains(c)).replace(' ', '-')
    val explicitly = "<a (?:id|name)=\"([^\"]+)\"".r.findAllMatchIn(text).map(_.group(1))
    headings.toSet ++ explicitly

  private val anchorsOf = scala.collection.mutable.Map.empty[Path, Set[String]]

  test("every relative link of a page leads to a file, and to a heading of it"):
    val wrong =
      for
        page <- pages
        text = Files.readString(page).replaceAll("(?s)```.*?```|`[^`\n]*`", "")
        target <- link.findAllMatchIn(text).map(_.group(1)).toVector
        if !target.contains("://") && !target.startsWith("mailto:")
        parts = target.split("#", 2)
        folder = Option(page.getParent).getOrElse(Path.of(""))
        file = if parts(0).isEmpty then page else folder.resolve(parts(0)).normalize
        problem <-
          if !Files.exists(file) then Some("no such file")
          else if parts.length > 1 && file.toString.endsWith(".md") &&
            !anchorsOf.getOrElseUpdate(file, anchors(Files.readString(file))).contains(parts(1))
          then Some("no such heading")
          else None
      yield s"$page: $target: $problem"
    assert(wrong.isEmpty, wrong.mkString("\n"))

  test("the README has at most 1,500 words"):
    assert(Files.readString(Path.of("README.md")).split("\\s+").length <= 1500)
