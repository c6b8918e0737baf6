package candela.scenefile

import candela.base.{FloatBuffer, IntBuffer, RestBuffer}
import candela.diagnostics.{Code, Problem, Refusal, SceneError, SourcePos}
import candela.io.IoReason
import java.io.{ByteArrayOutputStream, IOException}
import java.nio.charset.StandardCharsets.UTF_8
import java.util.Arrays

/** Splits a scene file into tokens, with one current token. Reads lists of numbers without creating
  * tokens. Commas are whitespace, which pbrt-v3 allows after numbers.
  *
  * @param includedFrom statement that includes this file
  * @param warn         receives warnings
  */
final class Tokenizer(
    val source: Source,
    val includedFrom: Option[SourcePos],
    warn: Problem => Unit = _ => ()
):
  private val number = NumberReader(source)
  private val names = NameCache()

  /** Offset of the first byte after the current token, and of its line, in the source's window.
    * `wide` counts the UTF-8 continuation bytes of this line.
    */
  private var cursor = source.start
  private var line = 1
  private var lineStart: Long = cursor
  private var wide = 0

  private var kind = Token.End
  private var start = 0
  private var tokenLine = 1
  private var tokenColumn = 1
  private var content: String | Null = null

  /** Kind of the current token. */
  def current: Token = kind

  /** Position of the current token. */
  def pos: SourcePos = SourcePos(source.name, tokenLine, tokenColumn, includedFrom)

  /** Position of the next token. */
  def nextPos: SourcePos =
    skipBlank()
    nextPlace

  private def nextPlace: SourcePos = SourcePos(source.name, line, column, includedFrom)

  /** Column of the byte at `cursor`. */
  private def column: Int = (cursor - lineStart - wide + 1).min(Int.MaxValue).toInt

  /** The current token: a word, or a string without quotes and escapes. */
  def text: String =
    val cached = content
    if cached != null then cached
    else
      val quote = if kind == Token.Text then 1 else 0
      val decoded = names.lookup(source, start + quote, cursor - quote)
      content = decoded
      decoded

  /** The current token as shown in messages. */
  def description: String =
    if kind == Token.End then "the end of the file"
    else
      val token = source.text(start, cursor)
      val name = if kind == Token.Word then Defines.nameIn(token) else None
      val cure =
        if token.exists(Tokenizer.CurlyQuotes.contains) then
          ", with curly quotes: replace them by straight ones, `\"`"
        else name.fold("")(n => s", which has no value (-D$n=VALUE sets it)")
      (if token.length > 60 then s"`${token.take(57)}…`" else s"`$token`") + cure

  def advance(): Unit =
    skipBlank()
    start = cursor
    tokenLine = line
    tokenColumn = column
    content = null
    if cursor >= source.limit then kind = Token.End
    else
      source.bytes(cursor) match
        case '[' =>
          cursor += 1
          kind = Token.Open
        case ']' =>
          cursor += 1
          kind = Token.Close
        case '"' => readText()
        case _ => readWord()

  /** Skips the current token and all up to a bare word that starts with a capital, as directives
    * do. Skips unreadable text, too.
    */
  def advanceToName(): Unit =
    var searching = true
    while searching do
      try
        advance()
        searching = kind != Token.End && !startsName
      catch case _: SceneError => ()

  /** Whether the current token is a bare word that starts with a capital. */
  def startsName: Boolean =
    kind == Token.Word && source.bytes(start) >= 'A' && source.bytes(start) <= 'Z'

  /** Whether only blanks are before the current token in its line, as far as is known. */
  def startsLine: Boolean =
    tokenLine == line && lineStart >= 0 &&
      (lineStart.toInt until start).forall(i => source.bytes(i) <= ' ')

  /** Whether the current token follows a quotation mark without a blank. */
  def touchesQuote: Boolean = start > 0 && source.bytes(start - 1) == '"'

  /** Whether the current token is a number. */
  def isNumber: Boolean = kind == Token.Word && number.scan(start) == cursor

  /** Appends the current token as a number; false if it isn't one. */
  def readFloat(into: FloatBuffer): Boolean =
    val isFloat = isNumber
    if isFloat then into += number.toFloat
    isFloat

  /** Whether an integer lost its fraction; the caller resets it. */
  var sawFraction = false

  /** Appends the current token as an integer; false if it isn't a number or doesn't fit an Int. */
  def readInt(into: IntBuffer): Boolean =
    val fits = isNumber && number.fitsInt
    if fits then addInt(into)
    fits

  /** Reads numbers from the current token on, as many as fit; returns how many there are. The token
    * after them becomes current.
    */
  def readDoubles(into: Array[Double]): Int =
    var count = 0
    if into.length > 0 && isNumber then
      into(0) = number.toDouble
      count = 1
      var end = if into.length > 1 then scanNext() else -1
      while end >= 0 do
        into(count) = number.toDouble
        count += 1
        cursor = end
        end = if count < into.length then scanNext() else -1
      advance()
    count

  /** Appends all numbers after the current token; the token after them becomes current.
    *
    * @param rests receives what Floats lack of large numbers
    */
  def readFloats(into: FloatBuffer, rests: RestBuffer): Unit =
    var end = scanNext()
    while end >= 0 do
      val x = number.toFloat
      if RestBuffer.isCoarse(x) then rests.note(into.length, number.toDouble, x)
      into += x
      cursor = end
      end = scanNext()
    advance()

  /** Appends integers as above; stops also before a number that doesn't fit an Int. */
  def readInts(into: IntBuffer): Unit =
    var end = scanNext()
    while end >= 0 && number.fitsInt do
      addInt(into)
      cursor = end
      end = scanNext()
    advance()

  private def addInt(into: IntBuffer): Unit =
    into += number.toInt
    if !number.isWhole then sawFraction = true

  /** Scans the next token; returns the offset after it, or −1 if it isn't a number. */
  private def scanNext(): Int =
    // Usually a single space precedes a number.
    if cursor < source.limit && source.bytes(cursor) == ' ' then cursor += 1
    if cursor >= source.limit || source.bytes(cursor) <= ',' then skipBlank()
    if source.limit - cursor < Tokenizer.UsualNumber then fetchNext(): Unit
    var end = number.scan(cursor)
    while number.stop == source.limit && fetchNext() do end = number.scan(cursor)
    end

  /** Whether a quoted string is next. */
  def nextIsText: Boolean =
    skipBlank()
    cursor < source.limit && source.bytes(cursor) == '"'

  private def skipBlank(): Unit =
    var inComment = false
    var continues = true
    while continues do
      val bytes = source.bytes
      val end = source.limit
      var i = cursor
      var isBlank = true
      while isBlank && i < end do
        val c = bytes(i)
        if c == ' ' || c == '\t' || c == ',' then i += 1
        else if c == '\n' || c == '\r' then
          val isPair = c == '\r' && i + 1 < end && bytes(i + 1) == '\n'
          // The window's last byte may be half of a pair.
          if c == '\r' && i + 1 == end && !source.isLast then isBlank = false
          else
            i += (if isPair then 2 else 1)
            line += 1
            lineStart = i
            wide = 0
            inComment = false
        else if inComment then i += 1
        else if c == '#' then inComment = true
        else isBlank = false
      cursor = i
      continues = (i == end || bytes(i) == '\r') && fetchNext()

  private def readWord(): Unit =
    kind = Token.Word
    var continues = true
    while continues do
      val bytes = source.bytes
      val end = source.limit
      var i = cursor
      while i < end && !NumberReader.isDelimiter(bytes(i)) do
        if isContinuation(bytes(i)) then wide += 1
        i += 1
      cursor = i
      continues = i == end && fetch()

  private def readText(): Unit =
    kind = Token.Text
    cursor += 1
    var hasEscapes = false
    var isEscaped = false
    var continues = true
    while continues do
      val bytes = source.bytes
      val end = source.limit
      var i = cursor
      while i < end && (bytes(i) != '"' || isEscaped) && bytes(i) != '\n' && bytes(i) != '\r' do
        isEscaped = bytes(i) == '\\' && !isEscaped
        hasEscapes |= isEscaped
        if isContinuation(bytes(i)) then wide += 1
        i += 1
      cursor = i
      continues = i == end && fetch()
    val isEnd = cursor >= source.limit
    if isEnd || source.bytes(cursor) != '"' then
      content = ""
      val message =
        if isEnd then "string not closed at the end of the file" else "string not closed"
      val isCurly = source.text(start, cursor).exists(Tokenizer.CurlyQuotes.contains)
      val cure =
        if isCurly then "replace curly quotes by straight ones, `\"`"
        else "end it with `\"` on the same line"
      throw SceneError(Problem.error(Code.Token, pos, message, Some(cure)))
    cursor += 1
    if hasEscapes then content = unescaped(start + 1, cursor - 1)

  private def unescaped(from: Int, until: Int): String =
    Escapes.unescaped(source.bytes, from, until): i =>
      val position = SourcePos(source.name, line, tokenColumn + i - start - 1, includedFrom)
      val letter = source.text(i, i + 1)
      val message = s"unknown escape sequence `\\$letter`, which pbrt-v3 and v4 reject; " +
        s"reading it as `$letter`, as pbrt-v2 does"
      val help = Some("write `\\\\` for a backslash, `/` between folders")
      warn(Problem.warning(Code.Token, position, message, help))

  private inline def isContinuation(c: Byte): Boolean = (c & 0xc0) == 0x80

  /** Slides the window to the next unread byte. */
  private def fetchNext(): Boolean =
    !source.isLast && { start = cursor; fetch() }

  /** Slides the window to the current token; false at the end of the file. */
  private def fetch(): Boolean =
    !source.isLast && {
      val position = if start < cursor then pos else nextPlace
      val offset = start
      try Refusal.placed(position)(source.slide(offset))
      catch
        case e: IOException =>
          source.close()
          cursor = source.limit
          start = cursor
          kind = Token.End
          throw SceneError(Problem.error(
            Code.Unreadable,
            position,
            s"can't read further: ${IoReason(e)}"
          ))
      start = 0
      cursor -= offset
      lineStart -= offset
      cursor < source.limit
    }

object Tokenizer:
  /** As word processors and web pages write quotes. */
  private val CurlyQuotes = "\u201c\u201d\u201e\u2018\u2019"

  /** Bytes that hold almost every number and its delimiter. */
  private val UsualNumber = 64

/** Escape sequences of quoted strings. */
private object Escapes:
  private val Written = "nrtbf\\\"'"
  private val Meant = "\n\r\t\b\f\\\"'"

  /** The unescaped text of a range. Unknown escapes mean the character itself.
    *
    * @param unknown receives the offset of the character after the backslash
    */
  def unescaped(bytes: Array[Byte], from: Int, until: Int)(unknown: Int => Unit): String =
    val buffer = ByteArrayOutputStream(until - from)
    var i = from
    while i < until do
      if bytes(i) != '\\' then buffer.write(bytes(i))
      else
        i += 1
        val meaning = Written.indexOf(bytes(i))
        if meaning < 0 then unknown(i)
        buffer.write(if meaning >= 0 then Meant.charAt(meaning).toInt else bytes(i).toInt)
      i += 1
    buffer.toString(UTF_8)

/** Converts words to Strings; caches the few names that recur, with their bytes. */
private final class NameCache:
  private val texts = new Array[String](NameCache.Slots)
  private val written = Array.fill(NameCache.Slots)(Array.emptyByteArray)

  /** The text of a range of the window of `source`. */
  def lookup(source: Source, from: Int, until: Int): String =
    val bytes = source.bytes
    var hash = until - from
    var i = from
    while i < until do
      hash = hash * 31 + bytes(i)
      i += 1
    val slot = (hash ^ (hash >>> 16)) & (NameCache.Slots - 1)
    val cachedBytes = written(slot)
    if texts(slot) == null || !Arrays.equals(cachedBytes, 0, cachedBytes.length, bytes, from, until)
    then
      texts(slot) = source.text(from, until)
      written(slot) = Arrays.copyOfRange(bytes, from, until)
    texts(slot)

private object NameCache:
  private val Slots = 256

/** Kinds of tokens: bare word (directive, number, `true`), quoted string, `[`, `]`, end of file. */
enum Token:
  case Word, Text, Open, Close, End
