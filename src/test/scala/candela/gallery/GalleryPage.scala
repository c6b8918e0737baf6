package candela.gallery

import candela.build.Category
import candela.cli.commands.{Described, DescribedType}
import candela.scenefile.Dialect

/** The gallery as a documentation page. */
final class GalleryPage(exhibits: Vector[Exhibit]):
  private val described = Described(Dialect.values.toSet)

  def text: String =
    (GalleryPage.Introduction +: exhibits.map(_.category).distinct.flatMap(section) :++ colors)
      .mkString("", "\n", "\n")

  private def section(category: Category): Vector[String] =
    val rows = exhibits
      .filter(_.category == category)
      .map: e =>
        val words = type_(e)
        val picture = e.reason match
          case Some(why) => why
          case None => s"![${words.title.replace("\"", "")}](${place(e.file)})"
        s"| $picture | [`${shown(e.recipe.name)}`](${link(e)}) | ${words.dialects} " +
          s"| ${words.meaning.replace("|", "\\|")} |"
    Vector("", s"## ${category.name}", "", s"${category.meaning.capitalize}.", "") ++
      Vector("| | type | in | meaning |", "|---|---|---|---|") ++ rows

  private val colors: Vector[String] =
    val rows = Comparisons.all.map: c =>
      val own = s"![${c.name} by Candela](${place(c.own)})"
      val pbrt = s"![${c.name} by pbrt-v4](${place(c.pbrt)})"
      s"| $own | $pbrt | [`${c.name}`](../scenes/${c.name}.pbrt) | ${c.effect} |"
    Vector("", "## Spectral rendering", "", GalleryPage.OfColors, "") ++
      Vector("| Candela | pbrt-v4 | scene | |", "|---|---|---|---|") ++ rows

  private def place(file: String) = s"gallery/$file${Gallery.Ending}"

  private def shown(name: String) = if name.isEmpty then "\"\"" else name

  private def type_(e: Exhibit): DescribedType =
    described.types(e.category)(e.category.recipes.all.indexOf(e.recipe))

  /** The type's heading in the reference. */
  def link(e: Exhibit): String =
    val words = type_(e)
    s"REFERENCE.md#${GalleryPage.anchor(s"${words.title}, ${words.dialects}")}"

object GalleryPage:
  /** GitHub's anchor of a heading. */
  def anchor(heading: String): String =
    heading.toLowerCase.filter(c => c.isLetterOrDigit || c == ' ' || c == '-' || c == '_')
      .replace(' ', '-')

  val OfColors: String =
    """Scenes of this repository where three numbers per colour are not enough, beside pbrt-v4's
      |images of them, which `ReferenceSuite` compares with Candela's. They are small; here, each
      |pixel is a square.""".stripMargin

  val Introduction: String =
    """# Gallery
      |
      |An image of each supported type of shape, material, texture, light, camera and medium,
      |[denoised](DENOISING.md). `./sbt "Test/runMain candela.gallery.Gallery"` regenerates this
      |page and its images from the recipes. The example scenes are in
      |`src/test/scala/candela/gallery`; a test fails if one is missing.
      |""".stripMargin.stripTrailing
