package candela.scenefile

import java.io.{ByteArrayOutputStream, IOException}
import java.nio.charset.StandardCharsets.UTF_8

import candela.base.{FloatBuffer, IntBuffer, Problem, SceneError, SourcePos}

/** Cuts a scene file into tokens. There is always one current token; lists of numbers are read
  * without making tokens of them. Commas are blanks, as pbrt-v3 has it behind numbers.
  *
  * @param includedFrom the statement that includes this file
  */
final class Tokenizer(val source: Source, val includedFrom: Option[SourcePos]):
  private val number = NumberReader(source)
  private val names = NameCache()

  /** The first byte after the current token, and where its line began: places in the source's
    * window. `wide` counts the bytes of this line that are not characters of their own (UTF-8
    * continuation).
    */
  private var next = source.start
  private var line = 1
  private var lineStart: Long = next
  private var wide = 0

  private var kind = Token.End
  private var start = 0
  private var tokenLine = 1
  private var tokenColumn = 1
  private var content = Option.empty[String]

  /** The kind of the current token. */
  def current: Token = kind

  /** Where the current token begins. */
  def at: SourcePos = SourcePos(source.name, tokenLine, tokenColumn, includedFrom)

  /** Where what follows the current token begins. */
  def nextAt: SourcePos =
    skipBlank()
    nextPlace

  private def nextPlace: SourcePos = SourcePos(source.name, line, column, includedFrom)

  /** Of the byte at `next`. */
  private def column: Int = (next - lineStart - wide + 1).min(Int.MaxValue).toInt

  /** The current token's word, or its text without quotes and escapes. */
  def text: String = content.getOrElse:
    val quote = if kind == Token.Text then 1 else 0
    val found = names.of(source, start + quote, next - quote)
    content = Some(found)
    found

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
    tokenColumn = column
    content = None
    if next >= source.limit then kind = Token.End
    else
      source.bytes(next) match
        case '[' =>
          next += 1
          kind = Token.Open
        case ']' =>
          next += 1
          kind = Token.Close
        case '"' => readText()
        case _ => readWord()

  /** Passes the current token and all that follow, up to a bare word that begins like a directive's
    * name. Unreadable text on the way is passed over.
    */
  def advanceToName(): Unit =
    var searching = true
    while searching do
      try
        advance()
        val isName = kind == Token.Word && source.bytes(start) >= 'A' && source.bytes(start) <= 'Z'
        searching = kind != Token.End && !isName
      catch case _: SceneError => ()

  /** Is the current token a number? If so, `number` has read it. */
  private def isNumber: Boolean = kind == Token.Word && number.scan(start) == next

  /** The current token as a number, if it is one. */
  def numberHere: Option[Double] = Option.when(isNumber)(number.toDouble)

  /** Reads the current token's number as one value; false if it is none. */
  def readFloat(into: FloatBuffer): Boolean =
    val found = isNumber
    if found then into += number.toFloat
    found

  /** Did a number that was read as an Int lose its fraction? Set back by who asks. */
  var sawFraction = false

  /** Likewise; false also for what no Int can hold. */
  def readInt(into: IntBuffer): Boolean =
    val found = isNumber && number.fitsInt
    if found then addInt(into)
    found

  /** Reads all numbers after the current token; what comes after them becomes the current token. */
  def readFloats(into: FloatBuffer): Unit =
    var end = scanNext()
    while end >= 0 do
      into += number.toFloat
      next = end
      end = scanNext()
    advance()

  /** Likewise; stops also before a number that no Int can hold. */
  def readInts(into: IntBuffer): Unit =
    var end = scanNext()
    while end >= 0 && number.fitsInt do
      addInt(into)
      next = end
      end = scanNext()
    advance()

  private def addInt(into: IntBuffer): Unit =
    into += number.toInt
    if !number.isWhole then sawFraction = true

  /** Scans the number that comes next, if it is one: the place after it, or −1. */
  private def scanNext(): Int =
    // mostly, one blank is before a number
    if next < source.limit && source.bytes(next) == ' ' then next += 1
    if next >= source.limit || source.bytes(next) <= ',' then skipBlank()
    if source.limit - next < Tokenizer.UsualNumber then fetchNext(): Unit
    var end = number.scan(next)
    while number.stop == source.limit && fetchNext() do end = number.scan(next)
    end

  /** Is a quoted text next? */
  def nextIsText: Boolean =
    skipBlank()
    next < source.limit && source.bytes(next) == '"'

  private def skipBlank(): Unit =
    var inComment = false
    var more = true
    while more do
      val bytes = source.bytes
      val end = source.limit
      var i = next
      var isBlank = true
      while isBlank && i < end do
        val c = bytes(i)
        if c == ' ' || c == '\t' || c == ',' then i += 1
        else if c == '\n' || c == '\r' then
          val isPair = c == '\r' && i + 1 < end && bytes(i + 1) == '\n'
          // the window's last byte may be half a pair
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
      next = i
      more = (i == end || bytes(i) == '\r') && fetchNext()

  private def readWord(): Unit =
    kind = Token.Word
    var more = true
    while more do
      val bytes = source.bytes
      val end = source.limit
      var i = next
      while i < end && !NumberReader.isDelimiter(bytes(i)) do
        if isContinuation(bytes(i)) then wide += 1
        i += 1
      next = i
      more = i == end && fetch()

  private def readText(): Unit =
    kind = Token.Text
    next += 1
    var hasEscapes = false
    var isEscaped = false
    var more = true
    while more do
      val bytes = source.bytes
      val end = source.limit
      var i = next
      while i < end && (bytes(i) != '"' || isEscaped) && bytes(i) != '\n' && bytes(i) != '\r' do
        isEscaped = bytes(i) == '\\' && !isEscaped
        hasEscapes |= isEscaped
        if isContinuation(bytes(i)) then wide += 1
        i += 1
      next = i
      more = i == end && fetch()
    val isEnd = next >= source.limit
    if isEnd || source.bytes(next) != '"' then
      content = Some("")
      val what = if isEnd then "the file ends inside this text" else "this text is not closed"
      throw SceneError(Problem.error(at, what, Some("end it with `\"` on the same line")))
    next += 1
    if hasEscapes then content = Some(unescaped(start + 1, next - 1))

  private def unescaped(from: Int, until: Int): String =
    Escapes.unescaped(source.bytes, from, until) match
      case Right(text) => text
      case Left(i) =>
        content = Some("")
        val place = SourcePos(source.name, line, tokenColumn + i - start - 1, includedFrom)
        val what = s"`\\${source.text(i, i + 1)}` has no meaning in a text"
        val help = Some("write `\\\\` for a backslash, `/` between folders")
        throw SceneError(Problem.error(place, what, help))

  private inline def isContinuation(c: Byte): Boolean = (c & 0xc0) == 0x80

  /** Moves the window on, so that it begins with what comes next. */
  private def fetchNext(): Boolean =
    !source.isLast && { start = next; fetch() }

  /** Moves the window on, so that it begins with the current token; false at the file's end. */
  private def fetch(): Boolean =
    !source.isLast && {
      val here = if start < next then at else nextPlace
      val from = start
      try source.slide(from)
      catch
        case e: IOException =>
          source.close()
          next = source.limit
          start = next
          kind = Token.End
          val why = Option(e.getMessage).getOrElse(e.toString)
          throw SceneError(Problem.error(here, s"reading stops: $why"))
      start = 0
      next -= from
      lineStart -= from
      next < source.limit
    }

object Tokenizer:
  /** So many bytes hold almost every number and what ends it. */
  private val UsualNumber = 64

/** What `\` and the byte after it mean in a quoted text. */
private object Escapes:
  private val Written = "nrtbf\\\"'"
  private val Meant = "\n\r\t\b\f\\\"'"

  /** The text between two places; or the place of a byte that has no meaning after `\`. */
  def unescaped(bytes: Array[Byte], from: Int, until: Int): Either[Int, String] =
    val out = ByteArrayOutputStream(until - from)
    var i = from
    var isKnown = true
    while i < until && isKnown do
      if bytes(i) != '\\' then out.write(bytes(i))
      else
        i += 1
        val meaning = Written.indexOf(bytes(i))
        isKnown = meaning >= 0
        if isKnown then out.write(Meant.charAt(meaning))
      if isKnown then i += 1
    if isKnown then Right(out.toString(UTF_8)) else Left(i)

/** Makes Strings of a file's words. The few names that occur again and again are made once, and
  * know their hash.
  */
private final class NameCache:
  private val known = new Array[String](NameCache.Slots)

  /** The text of `source` between two places of its window. */
  def of(source: Source, from: Int, until: Int): String =
    val bytes = source.bytes
    var hash = until - from
    var i = from
    while i < until do
      hash = hash * 31 + bytes(i)
      i += 1
    val slot = (hash ^ (hash >>> 16)) & (NameCache.Slots - 1)
    if !isSame(known(slot), bytes, from, until) then known(slot) = source.text(from, until)
    known(slot)

  /** Never so for texts with bytes beyond ASCII, which are no names. */
  private def isSame(name: String, bytes: Array[Byte], from: Int, until: Int): Boolean =
    name != null && name.length == until - from && {
      var i = 0
      while i < name.length && name.charAt(i) == bytes(from + i) do i += 1
      i == name.length
    }

private object NameCache:
  private val Slots = 256

/** What a token can be: a bare word (directive, number, `true`), a quoted text, `[`, `]`, or the
  * end.
  */
enum Token:
  case Word, Text, Open, Close, End
