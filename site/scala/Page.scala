package candela.site

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.commonmark.ext.gfm.tables.TablesExtension
import org.commonmark.node.{AbstractVisitor, Code, Heading, Node, Text}
import org.commonmark.parser.Parser

/** A page of the site.
  *
  * @param path   relative to the repository
  * @param root   its parsed Markdown
  */
final case class Page(path: Path, root: Node):
  private val children = Page.children(root)

  private val headings = children.collect { case h: Heading => h }

  val title: String = headings.headOption.fold(path.toString)(Page.text)

  /** Second-level headings: text and anchor. */
  val contents: Vector[(String, String)] =
    headings.filter(_.getLevel == 2).map(Page.text).map(t => t -> Page.anchor(t))

  /** Heading (none before the first), and the words below it. */
  val sections: Vector[(Option[String], String)] =
    val starts = children.indices.filter(i => children(i).isInstanceOf[Heading]).toVector
    starts
      .zip(starts.drop(1) :+ children.size)
      .zipWithIndex
      .map:
        case ((start, end), i) =>
          val words = children.slice(start + 1, end).map(Page.text).mkString(" ")
          Option.when(i > 0)(Page.text(children(start))) -> words

  /** Its address, from the root of the site. */
  def address: String = Page.address(path)

object Page:
  private val folders = Vector("docs", "deploy", "scenes", "reference-images")
  private val roots = Vector("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md")
  val extensions: java.util.List[org.commonmark.Extension] =
    java.util.List.of(TablesExtension.create())
  private val parser = Parser.builder.extensions(extensions).build

  def all(repository: Path): Vector[Page] =
    val below = folders.flatMap: folder =>
      Using.resource(Files.walk(repository.resolve(folder)))(_.iterator.asScala.toVector.sorted)
    (roots.map(repository.resolve) ++ below)
      .filter(_.toString.endsWith(".md"))
      .map(file => of(repository.relativize(file), Files.readString(file)))

  def of(path: Path, markdown: String): Page = Page(path, parser.parse(markdown))

  def address(path: Path): String =
    path.toString.replaceAll("README\\.md$", "index.html").replaceAll("\\.md$", ".html")

  def children(node: Node): Vector[Node] =
    Iterator.iterate(node.getFirstChild)(_.getNext).takeWhile(_ != null).toVector

  /** The text of a node, without marks. */
  def text(node: Node): String =
    val words = StringBuilder()
    node.accept:
      new AbstractVisitor:
        override def visit(text: Text): Unit = words ++= text.getLiteral
        override def visit(code: Code): Unit = words ++= code.getLiteral
        override def visit(line: org.commonmark.node.SoftLineBreak): Unit = words += ' '
        override def visit(paragraph: org.commonmark.node.Paragraph): Unit =
          visitChildren(paragraph)
          words += ' '
        override def visit(block: org.commonmark.node.FencedCodeBlock): Unit =
          words ++= block.getLiteral
        override def visit(cell: org.commonmark.node.CustomNode): Unit =
          visitChildren(cell)
          words += ' '
    words.toString.trim

  /** Anchors of headings, as GitHub makes them: links between pages count on it. */
  def anchor(title: String): String =
    title.toLowerCase.filter(c => c.isLetterOrDigit || " -_".contains(c)).replace(' ', '-')
