package candela.diagnostics

/** Truncates a source line to a readable width and positions its caret.
  *
  * Lines of up to 200 characters are shown whole. The excerpt of a longer line keeps the beginning
  * if its caret is at column 150 or before; otherwise it starts with `…` and has the caret at
  * column 80. So excerpt and true column together determine the caret.
  */
object Excerpt:
  private val Longest = 200
  private val LastPlain = 150
  private val CutCaret = 80
  private val Ellipsis = "…"

  /** @param before text left of the position (its last 200 characters suffice)
    * @param after text from the position on (its first 200 characters suffice)
    * @param column position in the whole line, counted from 1
    */
  def of(before: String, after: String, column: Int): String =
    val isWhole = length(before) == column - 1
    if isWhole && length(before) + length(after) <= Longest then before + after
    else if isWhole && column <= LastPlain then first(before + after, Longest - 1) + Ellipsis
    else
      val right = Longest - CutCaret
      val end = if length(after) > right then first(after, right) + Ellipsis else after
      Ellipsis + last(before, CutCaret - 2) + end

  /** Caret column under `excerpt` for a problem at `column` of the whole line. */
  def caret(excerpt: String, column: Int): Int =
    if column > LastPlain && excerpt.startsWith(Ellipsis) then CutCaret else column

  // Counts code points: an emoji is one column, not two.
  private def length(s: String): Int = s.codePointCount(0, s.length)

  private def first(s: String, count: Int): String =
    if length(s) <= count then s else s.substring(0, s.offsetByCodePoints(0, count))

  private def last(s: String, count: Int): String =
    if length(s) <= count then s else s.substring(s.offsetByCodePoints(s.length, -count))
