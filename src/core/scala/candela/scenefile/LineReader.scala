package candela.scenefile

import candela.base.loop

import java.nio.charset.StandardCharsets.ISO_8859_1
import java.util.Locale

/** A text and its place: line and column count from 1. */
final case class PlacedText(text: String, line: Int, column: Int)

/** Reads statements that are lines of words and numbers, byte by byte. `#` begins a comment; lines
  * end with `\n`, `\r\n` or `\r`.
  *
  * @param continues whether a line continues after `\` at its end
  * @param isShown   whether messages may quote the text
  * @param fail      reports a problem at a line and a column
  */
final class LineReader(
    source: Source,
    continues: Boolean,
    val isShown: Boolean,
    fail: (Int, Int, String) => Nothing
):
  private val scanner = NumberReader(source)
  private var lineStart, cursor, lineEnd, nextLine = source.start
  private var number = 0
  private var lineCount = 1

  /** Number of the line, from 1; 0 before the first. */
  def line: Int = number
  def column: Int = cursor - lineStart + 1

  def wrong(message: String): Nothing = fail(Math.max(number, 1), column, message)

  def wrongAt(line: Int, column: Int, message: String): Nothing = fail(line, column, message)

  /** To the next line; false at the end of the text. */
  def advance(): Boolean =
    number += (if number == 0 then 1 else lineCount)
    lineCount = 1
    lineStart = nextLine
    var i = lineStart
    var isWhole = false
    while !isWhole do
      if i + 1 >= source.limit && !source.isLast then
        source.slide(lineStart)
        i -= lineStart
        lineStart = 0
      else if i >= source.limit then isWhole = true
      else if !isLineEnd(source.bytes(i)) then i += 1
      else if continues && i > lineStart && source.bytes(i - 1) == '\\' then
        val width = endWidth(i)
        loop(i - 1, i + width)(k => source.bytes(k) = ' ')
        lineCount += 1
        i += width
      else isWhole = true
    lineEnd = i
    nextLine = if i < source.limit then i + endWidth(i) else i
    cursor = lineStart
    i < source.limit || i > lineStart

  private def isLineEnd(c: Byte): Boolean = c == '\n' || c == '\r'

  private def endWidth(i: Int): Int =
    val isPair = source.bytes(i) == '\r' && i + 1 < source.limit && source.bytes(i + 1) == '\n'
    if isPair then 2 else 1

  private def isBlankAt(i: Int): Boolean = source.bytes(i) <= ' ' && source.bytes(i) >= 0

  /** Whether the cursor is in a word, on this byte. */
  def isAt(c: Char): Boolean = cursor < lineEnd && source.bytes(cursor) == c

  /** Whether the cursor is behind a word. */
  def isAtEnd: Boolean = cursor >= lineEnd || isBlankAt(cursor)

  /** Whether the line has another word, at which the cursor is then. */
  def hasNext: Boolean =
    while cursor < lineEnd && isBlankAt(cursor) do cursor += 1
    cursor < lineEnd && source.bytes(cursor) != '#'

  def skip(bytes: Int): Unit = cursor += bytes

  /** A place in the line, to which [[moveTo]] returns. */
  def mark: Int = cursor
  def moveTo(mark: Int): Unit = cursor = mark

  /** Passes a word; of how many bytes. */
  def pass(): Int =
    val start = cursor
    while cursor < lineEnd && !isBlankAt(cursor) do cursor += 1
    cursor - start

  /** Passes digits; the number that they are, or one from `Int.MaxValue` on. */
  def digits(): Long =
    val bytes = source.bytes
    var n = 0L
    var i = cursor
    while i < lineEnd && bytes(i) >= '0' && bytes(i) <= '9' do
      if n < Int.MaxValue then n = 10 * n + (bytes(i) - '0')
      i += 1
    cursor = i
    n

  /** The byte of a mark. */
  def byteAt(mark: Int): Byte = source.bytes(mark)

  /** The text from a mark to the cursor. */
  def textFrom(mark: Int): String = source.text(mark, cursor)

  /** The next word; empty at the end of the line. */
  def word(): String =
    if !hasNext then ""
    else
      val start = cursor
      val _ = pass()
      textFrom(start)

  /** What follows in the line, without quotes around it. */
  def remainder(): PlacedText =
    val isAny = hasNext
    val placedColumn = column
    val start = cursor
    cursor = lineEnd
    while cursor > start && isBlankAt(cursor - 1) do cursor -= 1
    val text = if isAny then textFrom(start) else ""
    val isQuoted = text.length > 1 && text.head == '"' && text.last == '"'
    PlacedText(if isQuoted then text.slice(1, text.length - 1) else text, number, placedColumn)

  /** The number at the cursor, which stays there: for complaints about it. */
  def peek(): Float =
    if !hasNext then wrong("expected a number, found the end of the line")
    val end = scanner.scan(cursor)
    val isWord = end >= 0 && end <= lineEnd && (end == lineEnd || isBlankAt(end))
    if !isWord then wrong(s"expected a number, found $quotedWord")
    scanner.toFloat

  /** The number of the last `peek`, which is then passed. */
  def exact: Double = scanner.toDouble
  def passNumber(): Unit = cursor = scanner.stop

  def float(): Float =
    val x = peek()
    passNumber()
    x

  def finite(): Float =
    val x = peek()
    if !java.lang.Float.isFinite(x) then wrong(s"expected a finite number, found $quotedWord")
    passNumber()
    x

  /** Whether the word at the cursor is `nan`, `-nan(ind)`, `inf`, `1.#IND` or so. */
  def isUndefined: Boolean =
    hasNext && {
      val i = if isAt('-') || isAt('+') then cursor + 1 else cursor
      i + 2 < lineEnd && {
        val letters = String(source.bytes, i, 3, ISO_8859_1).toLowerCase(Locale.ROOT)
        letters == "nan" || letters == "inf" || letters == "1.#"
      }
    }

  /** A text, for messages. */
  def quoted(text: String): String = if isShown then s"`$text`" else "text that is not shown"

  /** The word at the cursor, for messages. */
  def quotedWord: String =
    var end = cursor
    while end < lineEnd && end < cursor + LineReader.MaxQuoted && !isBlankAt(end) do end += 1
    quoted(source.text(cursor, end))

object LineReader:
  private val MaxQuoted = 40
