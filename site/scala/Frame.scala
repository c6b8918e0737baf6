package candela.site

import java.nio.file.Path

/** What surrounds each page: the bar with the search, and the list of all pages. */
final class Frame(pages: Vector[Page]):
  private val groups: Vector[(String, Vector[Page])] =
    def in(folder: String) =
      val here = pages.filter(p => p.path.getParent == Path.of(folder))
      val (first, others) = here.partition(_.path.endsWith("README.md"))
      first ++ (if folder == "docs" then others.sortBy(_.title.toLowerCase) else others)
    val named = Vector("docs/guide", "docs", "docs/decisions")
    val rest = pages.filterNot(p => named.exists(in(_).contains(p)))
    Vector("Guide", "Pages", "Decisions").zip(named.map(in)) :+ ("Project" -> rest)

  def apply(page: Page, body: String): String =
    val up = "../" * (page.path.getNameCount - 1)
    def link(to: Page) =
      val here = if to == page then " aria-current=\"page\"" else ""
      s"<li><a href=\"$up${to.address}\"$here>${escaped(to.title)}</a></li>"
    val contents =
      page.contents.map((title, id) => s"<li><a href=\"#$id\">${escaped(title)}</a></li>")
    val own =
      if contents.size < 2 then ""
      else s"<details open><summary>On this page</summary><ul>${contents.mkString}</ul></details>"
    val lists =
      for (name, group) <- groups if group.nonEmpty yield
        val open = if group.contains(page) then " open" else ""
        s"<details$open><summary>$name</summary><ul>${group.map(link).mkString}</ul></details>"
    val shortcuts = Vector("docs/guide/README.md" -> "Guide", "docs/GALLERY.md" -> "Gallery") ++
      Vector("docs/REFERENCE.md" -> "Reference", "docs/README.md" -> "All pages")
    val bar =
      shortcuts.map((path, name) => s"<a href=\"$up${Page.address(Path.of(path))}\">$name</a>")
    s"""<!doctype html>
       |<html lang="en">
       |<head>
       |<meta charset="utf-8">
       |<meta name="viewport" content="width=device-width, initial-scale=1">
       |<meta name="color-scheme" content="light dark">
       |<title>${escaped(page.title)}${
        if page.title == "Candela" then "" else " · Candela"
      }</title>
       |<link rel="icon" href="data:,">
       |<link rel="stylesheet" href="${up}site.css">
       |<script src="${up}search.js" defer></script>
       |</head>
       |<body>
       |<header><a class="home" href="${up}index.html">Candela</a><nav>${bar.mkString}</nav><div class="search"></div></header>
       |<div class="columns">
       |<aside><details class="menu" open><summary>Contents</summary><nav>$own${lists.mkString}</nav></details></aside>
       |<main>$body</main>
       |</div>
       |</body>
       |</html>
       |""".stripMargin

  private def escaped(text: String) =
    text.replace("&", "&amp;").replace("<", "&lt;").replace("\"", "&quot;")
