package candela.site

/** What the search finds: sections of pages, with their words. */
object Search:
  /** A script that pages load when the search is first used: address, page, heading, text. */
  def index(pages: Vector[Page]): String =
    val entries =
      for page <- pages; (heading, words) <- page.sections
      yield
        val address = page.address + heading.fold("")(h => s"#${Page.anchor(h)}")
        Vector(address, page.title, heading.getOrElse(page.title), words)
          .map(quoted)
          .mkString("[", ",", "]")
    entries.mkString("window.candelaIndex=[\n", ",\n", "\n];\n")

  private def quoted(text: String): String =
    val escaped = text.replaceAll("\\s+", " ").flatMap:
      case '"' => "\\\""
      case '\\' => "\\\\"
      case c if c < ' ' => " "
      case c => c.toString
    s"\"$escaped\""
