package candela.gallery

import candela.build.Category
import candela.cli.{Described, DescribedType}
import candela.scenefile.Dialect

/** The gallery as a page of documentation. */
final class GalleryPage(exhibits: Vector[Exhibit]):
  private val described = Described(Dialect.values.toSet)

  def text: String =
    (GalleryPage.Introduction +: exhibits.map(_.category).distinct.flatMap(section))
      .mkString("", "\n", "\n")

  private def section(category: Category): Vector[String] =
    val rows = exhibits
      .filter(_.category == category)
      .map: e =>
        val words = type_(e)
        val picture = e.reason match
          case Some(why) => why
          case None => s"![${words.title.replace("\"", "")}](gallery/${e.file}.png)"
        s"| $picture | [`${shown(e.recipe.name)}`](${link(e)}) | ${words.dialects} " +
          s"| ${words.meaning.replace("|", "\\|")} |"
    Vector("", s"## ${category.name}", "", s"${category.meaning.capitalize}.", "") ++
      Vector("| | type | in | meaning |", "|---|---|---|---|") ++ rows

  private def shown(name: String) = if name.isEmpty then "\"\"" else name

  private def type_(e: Exhibit): DescribedType =
    described.types(e.category)(e.category.recipes.all.indexOf(e.recipe))

  /** Types without parameters have no heading of their own. */
  def link(e: Exhibit): String =
    val words = type_(e)
    val heading =
      if words.parameters.isEmpty then e.category.name else s"${words.title}, ${words.dialects}"
    s"REFERENCE.md#${GalleryPage.anchor(heading)}"

object GalleryPage:
  /** As GitHub names a heading. */
  def anchor(heading: String): String =
    heading.toLowerCase.filter(c => c.isLetterOrDigit || c == ' ' || c == '-' || c == '_')
      .replace(' ', '-')

  val Introduction: String =
    """# What there is, in pictures
      |
      |A small picture of each type of shape, material, texture, light, camera and medium that
      |Candela renders, mostly with its defaults. `./sbt "Test/runMain candela.gallery.Gallery"`
      |makes this page and its pictures anew from the tables that scenes are built by; how each type
      |is shown stands in `src/test/scala/candela/gallery`, and a test fails if one is missing.
      |""".stripMargin.stripTrailing
