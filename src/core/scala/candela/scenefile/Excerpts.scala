package candela.scenefile

import candela.diagnostics.{Excerpt, Problem, SourcePos}
import candela.io.InputFile
import java.io.IOException

/** Adds source excerpts to problems. */
object Excerpts:

  /** The problems, in order, each with an excerpt if its position is known and readable. */
  def fill(problems: Vector[Problem]): Vector[Problem] = fill(problems, read)

  /** As it is read again: the text, or files. */
  def sources(text: Option[NamedText])(name: String): Option[Source] =
    text.filter(_.name == name).fold(read(name))(t => Some(Source.fromText(name, t.content)))

  /** @param open opens the source of a name, from its start */
  def fill(problems: Vector[Problem], open: String => Option[Source]): Vector[Problem] =
    val lacking = problems.filter(p => p.pos.nonEmpty && p.excerpt.isEmpty)
    val lines = lacking.flatMap(_.pos).groupBy(_.file).toVector.flatMap: (name, positions) =>
      open(name).toVector.flatMap(excerpts(_, positions))
    val byPosition = lines.toMap
    problems.map(p =>
      p.copy(excerpt = p.excerpt.orElse(p.pos.flatMap(at => byPosition.get(key(at)))))
    )

  private def key(at: SourcePos): (String, Int, Int) = (at.file, at.line, at.column)

  def read(name: String): Option[Source] =
    InputFile.again(name).flatMap(Source.read(_).toOption)

  /** Reads the file once for all positions. */
  private def excerpts(source: Source, positions: Vector[SourcePos]) =
    val lines = Lines(source)
    try
      positions.sortBy(at => (at.line, at.column)).flatMap: at =>
        lines.excerpt(at).map(key(at) -> _)
    catch case _: IOException => Vector.empty
    finally source.close()

/** Scans a file from position to position. */
private final class Lines(source: Source):
  private var line = 1
  private var column = 1
  private var lineStart = source.start
  private var cursor = source.start

  /** The text around `at`; positions must not decrease between calls. */
  def excerpt(at: SourcePos): Option[String] =
    while line < at.line && isAvailable(0) do pass()
    Option.when(line == at.line):
      while column < at.column && !isLineEnd(0) do pass()
      // Far more bytes than the shown characters need, yet not a line of 100 MB.
      var count = 0
      while count < Lines.MaxBytes && !isLineEnd(count) do count += 1
      while isContinuation(count) do count += 1
      var start = earliest
      while start < cursor && isContinuation(start - cursor) do start += 1
      Excerpt.of(source.text(start, cursor), source.text(cursor, cursor + count), column)

  /** Passes a character or a line end: `\n`, `\r\n` or `\r`. */
  private def pass(): Unit =
    if isLineEnd(0) then
      cursor += (if byte(0) == '\r' && isAvailable(1) && byte(1) == '\n' then 2 else 1)
      lineStart = cursor
      line += 1
      column = 1
    else
      cursor += 1
      while isContinuation(0) do cursor += 1
      column += 1

  private def isLineEnd(i: Int): Boolean = !isAvailable(i) || byte(i) == '\n' || byte(i) == '\r'
  private def isContinuation(i: Int): Boolean = isAvailable(i) && (byte(i) & 0xc0) == 0x80
  private def byte(i: Int): Byte = source.bytes(cursor + i)

  /** Whether the `i`-th byte from `cursor` exists; slides the window if needed. */
  private def isAvailable(i: Int): Boolean =
    while cursor + i >= source.limit && !source.isLast do
      val start = earliest
      source.slide(start)
      cursor -= start
      lineStart = (lineStart - start).max(-1)
    cursor + i < source.limit

  /** First byte that may still be shown. */
  private def earliest: Int = lineStart.max(cursor - Lines.MaxBytes).max(0)

private object Lines:
  private val MaxBytes = 1000
