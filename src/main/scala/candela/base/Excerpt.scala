package candela.base

/** How a line of a file is cut to a width that can be read, and where its caret then stands.
  *
  * Lines of up to 200 characters are shown whole. Of a longer one, an excerpt whose caret is at
  * column 150 or before keeps the beginning; any other starts with `…` and has the caret at column
  * 80. So the excerpt and the true column tell together where the caret belongs.
  */
object Excerpt:
  private val Longest = 200
  private val LastPlain = 150
  private val CutCaret = 80
  private val Ellipsis = "…"

  /** @param before the line's text left of the place (its last 200 characters are enough)
    * @param after  the rest (its first 200 characters are enough)
    * @param column the place, counted from 1 in the whole line
    */
  def of(before: String, after: String, column: Int): String =
    val isWhole = length(before) == column - 1
    if isWhole && length(before) + length(after) <= Longest then before + after
    else if isWhole && column <= LastPlain then first(before + after, Longest - 1) + Ellipsis
    else
      val right = Longest - CutCaret
      val end = if length(after) > right then first(after, right) + Ellipsis else after
      Ellipsis + last(before, CutCaret - 2) + end

  /** The column of the caret under `excerpt` for a problem at `column` of the whole line. */
  def caret(excerpt: String, column: Int): Int =
    if column > LastPlain && excerpt.startsWith(Ellipsis) then CutCaret else column

  // Characters are code points: an emoji is one column, not two.
  private def length(s: String): Int = s.codePointCount(0, s.length)

  private def first(s: String, count: Int): String =
    if length(s) <= count then s else s.substring(0, s.offsetByCodePoints(0, count))

  private def last(s: String, count: Int): String =
    if length(s) <= count then s else s.substring(s.offsetByCodePoints(s.length, -count))
