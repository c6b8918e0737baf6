package candela.cli.terminal

/** Lays out rows of cells: each column as wide as needed, the last one wrapped.
  *
  * @param columns terminal width, in characters
  */
final class TextTable(columns: Int):

  def lines(rows: Vector[Vector[String]], indent: Int = 2): Vector[String] =
    if rows.isEmpty then Vector.empty
    else
      val wanted = rows.head.indices.init.map(i => rows.map(_(i).length).max)
      def room(widest: Int) =
        columns - indent - wanted.map(w => w.min(widest) + TextTable.Gap).sum
      val widest = TextTable.Widest.find(room(_) >= TextTable.MinTextColumns).getOrElse(12)
      val fixed = wanted.map(_.min(widest))
      val width = Math.max(TextTable.MinTextColumns, room(widest))
      rows.flatMap: row =>
        val cells =
          row.init.zip(fixed).map((text, w) => TextTable.wrap(text, w).map(_.padTo(w, ' ')))
        val last = TextTable.wrap(row.last, width)
        val height = (cells.map(_.size) :+ last.size).max
        Vector.tabulate(height): i =>
          val padded = cells.zip(fixed).map((c, w) => c.applyOrElse(i, _ => " " * w))
          val line = (padded :+ last.applyOrElse(i, _ => "")).mkString(" " * TextTable.Gap)
          (" " * indent + line).stripTrailing

object TextTable:
  private val Gap = 2

  /** Candidate limits for all columns but the last; the widest that leaves it room is used, and
    * longer cells wrap.
    */
  private val Widest = 26 to 12 by -1

  /** Minimum width of the last column, however narrow the terminal. */
  private val MinTextColumns = 24

  /** Breaks between words; words longer than a line stay whole. */
  def wrap(text: String, width: Int): Vector[String] =
    text
      .split(' ')
      .foldLeft(Vector("")): (lines, word) =>
        val last = lines.last
        if last.isEmpty then lines.init :+ word
        else if last.length + 1 + word.length <= width then lines.init :+ s"$last $word"
        else lines :+ word
