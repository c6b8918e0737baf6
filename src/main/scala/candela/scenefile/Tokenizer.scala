package candela.scenefile

import java.io.ByteArrayOutputStream
import java.nio.charset.StandardCharsets.UTF_8

import candela.base.{Problem, SceneError, SourcePos}

/** What a token can be: a bare word (directive, number, `true`), a quoted text, `[`, `]`, or the
  * end.
  */
enum Token:
  case Word, Text, Open, Close, End

/** Cuts a scene file into tokens. There is always one current token; lists of numbers are read
  * without making tokens of them.
  *
  * @param includedFrom the statement that includes this file
  */
final class Tokenizer(val source: Source, val includedFrom: Option[SourcePos]):
  private val bytes = source.bytes
  private val number = NumberReader(bytes)

  /** The first byte after the current token, and where its line began. `wide` counts the bytes of
    * this line that are not characters of their own (UTF-8 continuation).
    */
  private var next = source.start
  private var line = 1
  private var lineStart = next
  private var wide = 0

  private var kind = Token.End
  private var start = 0
  private var tokenLine = 1
  private var tokenColumn = 1
  private var content = ""

  /** The kind of the current token. */
  def current: Token = kind

  /** Where the current token begins. */
  def at: SourcePos = SourcePos(source.name, tokenLine, tokenColumn, includedFrom)

  /** Where what follows the current token begins. */
  def nextAt: SourcePos =
    skipBlank()
    SourcePos(source.name, line, next - lineStart - wide + 1, includedFrom)

  /** The current token's word, or its text without quotes and escapes. */
  def text: String = if kind == Token.Text then content else source.text(start, next)

  /** The current token as a message shows it. */
  def shown: String =
    if kind == Token.End then "the end of the file"
    else
      val all = source.text(start, next)
      if all.length > 60 then s"`${all.take(57)}…`" else s"`$all`"

  def advance(): Unit =
    skipBlank()
    start = next
    tokenLine = line
    tokenColumn = start - lineStart - wide + 1
    if next >= bytes.length then kind = Token.End
    else
      bytes(next) match
        case '[' =>
          next += 1
          kind = Token.Open
        case ']' =>
          next += 1
          kind = Token.Close
        case '"' => readText()
        case _ =>
          while next < bytes.length && !NumberReader.isDelimiter(bytes(next)) do
            if isContinuation(bytes(next)) then wide += 1
            next += 1
          kind = Token.Word

  /** Passes the current token and all that follow, up to a bare word that begins like a directive's
    * name. Unreadable text on the way is passed over.
    */
  def advanceToName(): Unit =
    var searching = true
    while searching do
      try
        advance()
        val isName = kind == Token.Word && bytes(start) >= 'A' && bytes(start) <= 'Z'
        searching = kind != Token.End && !isName
      catch case _: SceneError => ()

  /** Is the current token a number? If so, `number` has read it. */
  private def isNumber: Boolean = kind == Token.Word && number.scan(start) == next

  /** The current token as a number, if it is one. */
  def numberHere: Option[Double] = Option.when(isNumber)(number.toDouble)

  /** Reads the current token's number as one value; false if it is none. */
  def readFloat(into: FloatBuffer): Boolean =
    val found = isNumber
    if found then into.add(number.toFloat)
    found

  /** Likewise; false also for what no Int can hold. */
  def readInt(into: IntBuffer): Boolean =
    val found = isNumber && number.fitsInt
    if found then addInt(into)
    found

  /** Reads all numbers after the current token; what comes after them becomes the current token. */
  def readFloats(into: FloatBuffer): Unit =
    skipBlank()
    var end = number.scan(next)
    while end >= 0 do
      into.add(number.toFloat)
      next = end
      skipBlank()
      end = number.scan(next)
    advance()

  /** Likewise; stops also before a number that no Int can hold. */
  def readInts(into: IntBuffer): Unit =
    skipBlank()
    var end = number.scan(next)
    while end >= 0 && number.fitsInt do
      addInt(into)
      next = end
      skipBlank()
      end = number.scan(next)
    advance()

  private def addInt(into: IntBuffer): Unit =
    into.add(number.toInt)
    if !number.isWhole then into.sawFraction = true

  /** Is a quoted text next? */
  def nextIsText: Boolean =
    skipBlank()
    next < bytes.length && bytes(next) == '"'

  private def skipBlank(): Unit =
    var i = next
    var isBlank = true
    while isBlank && i < bytes.length do
      val c = bytes(i)
      if c == ' ' || c == '\t' then i += 1
      else if c == '\n' || c == '\r' then i = endLine(i)
      else if c == '#' then while i < bytes.length && bytes(i) != '\n' && bytes(i) != '\r' do i += 1
      else isBlank = false
    next = i

  /** Passes the line end at `i`: `\n`, `\r\n` or `\r`. */
  private def endLine(i: Int): Int =
    val isPair = bytes(i) == '\r' && i + 1 < bytes.length && bytes(i + 1) == '\n'
    line += 1
    lineStart = if isPair then i + 2 else i + 1
    wide = 0
    lineStart

  private def readText(): Unit =
    var i = start + 1
    var hasEscapes = false
    var isPlain = true
    while i < bytes.length && bytes(i) != '"' && bytes(i) != '\n' && bytes(i) != '\r' do
      if bytes(i) < 0 then
        isPlain = false
        if isContinuation(bytes(i)) then wide += 1
      if bytes(i) == '\\' then
        hasEscapes = true
        if i + 1 < bytes.length && bytes(i + 1) != '\n' && bytes(i + 1) != '\r' then i += 1
      i += 1
    if i >= bytes.length || bytes(i) != '"' then
      next = i.min(bytes.length)
      kind = Token.Text
      content = ""
      val isEnd = i >= bytes.length
      val what = if isEnd then "the file ends inside this text" else "this text is not closed"
      throw SceneError(Problem.error(at, what, Some("end it with `\"` on the same line")))
    next = i + 1
    kind = Token.Text
    content =
      if hasEscapes then unescaped(start + 1, i)
      else if isPlain then Tokenizer.ascii(bytes, start + 1, i)
      else source.text(start + 1, i)

  private def unescaped(from: Int, until: Int): String =
    val out = ByteArrayOutputStream(until - from)
    var i = from
    while i < until do
      if bytes(i) != '\\' then out.write(bytes(i))
      else
        i += 1
        val meaning = Tokenizer.Escapes.indexOf(bytes(i))
        if meaning >= 0 then out.write(Tokenizer.Escaped.charAt(meaning))
        else
          throw SceneError(
            Problem.error(
              SourcePos(source.name, line, tokenColumn + i - start - 1, includedFrom),
              s"`\\${source.text(i, i + 1)}` has no meaning in a text",
              Some("write `\\\\` for a backslash, `/` between folders")
            )
          )
      i += 1
    out.toString(UTF_8)

  private inline def isContinuation(c: Byte): Boolean = (c & 0xc0) == 0x80

object Tokenizer:
  private val Escapes = "nrtbf\\\"'"
  private val Escaped = "\n\r\t\b\f\\\"'"

  private def ascii(bytes: Array[Byte], from: Int, until: Int): String =
    new String(bytes, from, until - from, java.nio.charset.StandardCharsets.ISO_8859_1)
