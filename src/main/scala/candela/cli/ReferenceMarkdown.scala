package candela.cli

import candela.build.{Category, Language}

/** The reference as a page of documentation. */
final class ReferenceMarkdown(described: Described):

  def page: Vector[String] =
    ReferenceMarkdown.Introduction.linesIterator.toVector ++
      Language.categories.filter(described.types(_).nonEmpty).flatMap(category)

  private def category(c: Category): Vector[String] =
    val types = described.types(c)
    val rows = types.map: t =>
      val name = if t.name.isEmpty then t.title else t.name
      val support = t.pending.fold("")(instead => s"not yet: $instead")
      row(s"`$name`", t.dialects, t.meaning, support)
    val overview =
      if types.size < 2 then Vector.empty
      else "" +: row("type", "in", "meaning", "support") +: rule(4) +: rows
    Vector("", s"## ${c.name}", "", c.meaning.capitalize + ".") ++ overview ++
      types.filter(_.parameters.nonEmpty).flatMap(parameters)

  private def parameters(t: DescribedType): Vector[String] =
    val rows = t.parameters.map: p =>
      row(s"`${p.name}`", p.typeName, p.default, p.dialects, p.meaning)
    val support = t.pending.map(instead => s" Not supported yet: $instead.").getOrElse("")
    Vector("", s"### ${t.title}, ${t.dialects}", "", s"${t.meaning.capitalize}.$support", "") ++
      (row("name", "type", "default", "in", "meaning") +: rule(5) +: rows)

  private def row(cells: String*): String =
    cells.map(_.replace("|", "\\|")).mkString("| ", " | ", " |")

  private def rule(cells: Int): String = "|" + "---|" * cells

private object ReferenceMarkdown:
  val Introduction: String =
    """# What scene files can say
      |
      |Every type and parameter of pbrt-v2, v3 and v4, with what Candela makes of it. This page is
      |printed by `candela describe --markdown`; `./sbt "run describe --markdown --outfile
      |docs/REFERENCE.md"` makes it anew.
      |
      |A type of values is what stands before the parameter's name: `"float radius" 2`. `float
      |texture` and `spectrum texture` are a value or `"texture NAME" "TEXTURE"`. A `spectrum` is
      |written as `rgb`, `spectrum` or `blackbody`, in v2 and v3 also as `color` or `xyz`. Units are
      |in brackets.""".stripMargin
