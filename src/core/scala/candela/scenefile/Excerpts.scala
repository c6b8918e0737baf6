package candela.scenefile

import java.io.IOException

import candela.base.{Excerpt, InputFile, Problem, SourcePos}

/** Adds source excerpts to problems. */
object Excerpts:

  /** The problems, in order, each with an excerpt if its position is known and readable. */
  def fill(problems: Vector[Problem]): Vector[Problem] = fill(problems, read)

  /** @param open opens the source of a name, from its start */
  def fill(problems: Vector[Problem], open: String => Option[Source]): Vector[Problem] =
    val lacking = problems.filter(p => p.at.nonEmpty && p.excerpt.isEmpty)
    val lines = lacking.flatMap(_.at).groupBy(_.file).toVector.flatMap: (name, places) =>
      open(name).toVector.flatMap(excerpts(_, places))
    val byPlace = lines.toMap
    problems.map(p => p.copy(excerpt = p.excerpt.orElse(p.at.flatMap(at => byPlace.get(key(at))))))

  private def key(at: SourcePos): (String, Int, Int) = (at.file, at.line, at.column)

  def read(name: String): Option[Source] =
    InputFile.again(name).flatMap(Source.read(_).toOption)

  /** Reads the file once for all positions. */
  private def excerpts(source: Source, places: Vector[SourcePos]) =
    val lines = Lines(source)
    try
      places.sortBy(at => (at.line, at.column)).flatMap: at =>
        lines.excerpt(at).map(key(at) -> _)
    catch case _: IOException => Vector.empty
    finally source.close()

/** Scans a file from position to position. */
private final class Lines(source: Source):
  private var line = 1
  private var column = 1
  private var lineStart = source.start
  private var next = source.start

  /** The text around `at`; positions must not decrease between calls. */
  def excerpt(at: SourcePos): Option[String] =
    while line < at.line && has(0) do pass()
    Option.when(line == at.line):
      while column < at.column && !isLineEnd(0) do pass()
      // Far more bytes than the shown characters need, yet not a line of 100 MB.
      var count = 0
      while count < Lines.MaxBytes && !isLineEnd(count) do count += 1
      while isContinuation(count) do count += 1
      var from = earliest
      while from < next && isContinuation(from - next) do from += 1
      Excerpt.of(source.text(from, next), source.text(next, next + count), column)

  /** Passes a character or a line end: `\n`, `\r\n` or `\r`. */
  private def pass(): Unit =
    if isLineEnd(0) then
      next += (if byte(0) == '\r' && has(1) && byte(1) == '\n' then 2 else 1)
      lineStart = next
      line += 1
      column = 1
    else
      next += 1
      while isContinuation(0) do next += 1
      column += 1

  private def isLineEnd(i: Int): Boolean = !has(i) || byte(i) == '\n' || byte(i) == '\r'
  private def isContinuation(i: Int): Boolean = has(i) && (byte(i) & 0xc0) == 0x80
  private def byte(i: Int): Byte = source.bytes(next + i)

  /** Whether the `i`-th byte from `next` exists; slides the window if needed. */
  private def has(i: Int): Boolean =
    while next + i >= source.limit && !source.isLast do
      val from = earliest
      source.slide(from)
      next -= from
      lineStart = (lineStart - from).max(-1)
    next + i < source.limit

  /** First byte that may still be shown. */
  private def earliest: Int = lineStart.max(next - Lines.MaxBytes).max(0)

private object Lines:
  private val MaxBytes = 1000
