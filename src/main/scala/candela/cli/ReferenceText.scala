package candela.cli

import candela.build.{Category, Language}

/** The reference as it looks on a terminal. */
final class ReferenceText(described: Described, columns: Int):
  private val table = TextTable(columns)

  /** All categories. */
  def categories: Vector[String] =
    val rows =
      for c <- Language.categories; types = described.types(c) if types.nonEmpty
      yield
        val counted = types.map(_.name).distinct.size
        Vector(c.name, if counted > 1 then s"$counted types" else "", c.meaning)
    table.lines(rows, indent = 0) ++
      Vector(
        "",
        "`candela describe CATEGORY` lists types, `candela describe TYPE` parameters."
      )

  /** A category's types; the parameters themselves, if there is but one type. */
  def category(c: Category): Vector[String] =
    described.types(c) match
      case Vector(only) => parameters(only)
      case types =>
        val rows = types.map: t =>
          val later = t.pending.fold("")(instead => s"; not supported yet: $instead")
          Vector(s"\"${t.name}\"", t.dialects, t.meaning + later)
        s"${c.name}: ${c.meaning}" +: "" +: table.lines(rows)

  def parameters(t: DescribedType): Vector[String] =
    val head = TextTable.wrap(s"${t.title} (${t.dialects}): ${t.meaning}", columns)
    val later = t.pending.toVector.flatMap: instead =>
      TextTable.wrap(s"Not supported yet: $instead.", columns)
    val names = Vector("name", "type", "default", "in", "meaning")
    val rows = t.parameters.map(p => Vector(p.name, p.typeName, p.default, p.dialects, p.meaning))
    val body =
      if rows.isEmpty then Vector("  no parameters") else table.lines(names +: rows)
    head ++ later ++ ("" +: body)
