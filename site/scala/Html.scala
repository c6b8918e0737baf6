package candela.site

import java.nio.file.{Files, Path}

import scala.collection.mutable

import org.commonmark.node.{Heading, Image, Link, Node}
import org.commonmark.renderer.html.{AttributeProvider, HtmlRenderer}

/** Renders pages, and collects the other files that they link to.
  *
  * @param listings   folders that pages link to and that have no page of their own, filled here
  */
final class Html(repository: Path, pages: Vector[Page]):
  private val isPage = pages.map(_.path).toSet
  val files: mutable.LinkedHashSet[Path] = mutable.LinkedHashSet.empty
  val listings: mutable.LinkedHashSet[Path] = mutable.LinkedHashSet.empty

  def apply(page: Page): String =
    val attributes: AttributeProvider = (node, _, attributes) =>
      node match
        case link: Link =>
          val _ = attributes.put("href", target(page, link.getDestination))
        case image: Image =>
          val _ = attributes.put("src", target(page, image.getDestination))
          val _ = attributes.put("loading", "lazy")
        case heading: Heading =>
          val _ = attributes.put("id", Page.anchor(Page.text(heading)))
        case _ => ()
    HtmlRenderer.builder
      .extensions(Page.extensions)
      .attributeProviderFactory(_ => attributes)
      .build
      .render(page.root: Node)

  private def target(page: Page, link: String): String =
    if link.matches("[a-z]+:.*") || link.startsWith("#") then link
    else
      val (name, anchor) = link.span(_ != '#')
      val here = Option(page.path.getParent).getOrElse(Path.of(""))
      val file = here.resolve(name).normalize
      def from(path: String) = s"${here.relativize(Path.of(path))}$anchor"
      if isPage(file) then from(Page.address(file))
      else if Files.isDirectory(repository.resolve(file)) then
        val index = file.resolve("README.md")
        if !isPage(index) then
          val _ = listings.add(file)
        from(Page.address(index))
      else
        val _ = files.add(file)
        from(file.toString)
