package candela.scenefile

import java.nio.file.{InvalidPathException, Path}

import candela.base.{Excerpt, Problem, SourcePos}

/** Adds to problems the lines of the files that they are about. */
object Excerpts:

  /** The problems in their order, each with its excerpt, if it has a place and the place can be
    * read.
    */
  def fill(problems: Vector[Problem]): Vector[Problem] = fill(problems, Map.empty)

  /** @param known sources that are no files, by name */
  def fill(problems: Vector[Problem], known: Map[String, Source]): Vector[Problem] =
    val lacking = problems.filter(p => p.at.nonEmpty && p.excerpt.isEmpty)
    val lines = lacking.flatMap(_.at).groupBy(_.file).toVector.flatMap: (name, places) =>
      known.get(name).orElse(read(name)).toVector.flatMap(excerpts(_, places))
    val byPlace = lines.toMap
    problems.map(p => p.copy(excerpt = p.excerpt.orElse(p.at.flatMap(at => byPlace.get(key(at))))))

  private def key(at: SourcePos): (String, Int, Int) = (at.file, at.line, at.column)

  private def read(name: String): Option[Source] =
    try Source.read(Path.of(name)).toOption
    catch case _: InvalidPathException => None

  /** One pass over the file, however many places there are. */
  private def excerpts(source: Source, places: Vector[SourcePos]) =
    var line = 1
    var start = source.start
    places.sortBy(_.line).flatMap: at =>
      while line < at.line && start < source.bytes.length do
        start = afterLine(source, start)
        line += 1
      Option.when(line == at.line)(key(at) -> excerpt(source, start, at.column))

  private def excerpt(source: Source, start: Int, column: Int): String =
    val bytes = source.bytes
    def isContinuation(i: Int) = i < bytes.length && (bytes(i) & 0xc0) == 0x80
    var end = start
    while end < bytes.length && bytes(end) != '\n' && bytes(end) != '\r' do end += 1
    var place = start
    var at = 1
    while at < column && place < end do
      place += 1
      while isContinuation(place) do place += 1
      at += 1
    // far more bytes than the shown characters can have, but not a line of 100 MB
    var from = start.max(place - 1000)
    while isContinuation(from) do from += 1
    var until = end.min(place + 1000)
    while until < end && isContinuation(until) do until += 1
    Excerpt.of(source.text(from, place), source.text(place, until), at)

  private def afterLine(source: Source, start: Int): Int =
    val bytes = source.bytes
    var i = start
    while i < bytes.length && bytes(i) != '\n' && bytes(i) != '\r' do i += 1
    if i + 1 < bytes.length && bytes(i) == '\r' && bytes(i + 1) == '\n' then i + 2 else i + 1
