package candela.scenefile

import java.io.IOException
import java.nio.file.{InvalidPathException, Path}

import candela.base.{Excerpt, Problem, SourcePos}

/** Adds to problems the lines of the files that they are about. */
object Excerpts:

  /** The problems in their order, each with its excerpt, if it has a place and the place can be
    * read.
    */
  def fill(problems: Vector[Problem]): Vector[Problem] = fill(problems, read)

  /** @param open the source of a name, from its start */
  def fill(problems: Vector[Problem], open: String => Option[Source]): Vector[Problem] =
    val lacking = problems.filter(p => p.at.nonEmpty && p.excerpt.isEmpty)
    val lines = lacking.flatMap(_.at).groupBy(_.file).toVector.flatMap: (name, places) =>
      open(name).toVector.flatMap(excerpts(_, places))
    val byPlace = lines.toMap
    problems.map(p => p.copy(excerpt = p.excerpt.orElse(p.at.flatMap(at => byPlace.get(key(at))))))

  private def key(at: SourcePos): (String, Int, Int) = (at.file, at.line, at.column)

  def read(name: String): Option[Source] =
    try Source.read(Path.of(name)).toOption
    catch case _: InvalidPathException => None

  /** One pass over the file, however many places there are. */
  private def excerpts(source: Source, places: Vector[SourcePos]) =
    val lines = Lines(source)
    try
      places.sortBy(at => (at.line, at.column)).flatMap: at =>
        lines.excerpt(at).map(key(at) -> _)
    catch case _: IOException => Vector.empty
    finally source.close()

/** Goes through a file from place to place. */
private final class Lines(source: Source):
  private var line = 1
  private var column = 1
  private var lineStart = source.start
  private var next = source.start

  /** The text around a place, which lies at or behind the one that was asked for before. */
  def excerpt(at: SourcePos): Option[String] =
    while line < at.line && has(0) do pass()
    Option.when(line == at.line):
      while column < at.column && !isLineEnd(0) do pass()
      // far more bytes than the shown characters can have, but not a line of 100 MB
      var count = 0
      while count < Lines.Shown && !isLineEnd(count) do count += 1
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

  /** Is there an `i`-th byte from `next` on? Moves the window if need be. */
  private def has(i: Int): Boolean =
    while next + i >= source.limit && !source.isLast do
      val from = earliest
      source.slide(from)
      next -= from
      lineStart = (lineStart - from).max(-1)
    next + i < source.limit

  /** The first byte that can be shown yet. */
  private def earliest: Int = lineStart.max(next - Lines.Shown).max(0)

private object Lines:
  private val Shown = 1000
