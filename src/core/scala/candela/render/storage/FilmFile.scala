package candela.render.storage

import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{CheckedFile, ForeignFile, ForeignKind, InputFile, IoReason, NextFile, WholeFile}
import candela.render.RenderState

import java.io.{EOFException, IOException}
import java.nio.file.{Files, Path}
import java.util.Locale

import scala.util.Try

/** A saved rendering.
  *
  * @param path   as it was asked for
  * @param source the file that was read: `path` or its previous copy
  * @param damage what is wrong with `path`, if it is the previous copy
  */
final class FilmFile private (
    val path: Path,
    val header: FilmHeader,
    source: Path,
    val damage: Option[String]
):
  /** Adds the saved state to `state`.
    *
    * @throws SceneError if it is damaged, or of another image
    */
  def load(state: RenderState): Unit =
    try
      FilmFile.sound:
        CheckedFile.read(source, FilmFile.Mark): in =>
          val done = FilmHeader.load(in).done
          state.load(in)
          require(state.hasReached(done), s"it has fewer than $done samples per pixel")
    catch
      case e: IOException =>
        throw SceneError(Problem.general(
          Code.DamagedFilm,
          s"can't read `$source`: ${FilmFile.reason(e)}"
        ))

object FilmFile:
  private[storage] val Mark = "Candela film 3\n"

  /** File extension. */
  val Suffix = "film"

  /** Whether a file's name has the extension, in letters of any case. */
  def isName(file: String): Boolean = file.toLowerCase(Locale.ROOT).endsWith(s".$Suffix")

  /** Where the previous copy is kept: beside the file, not beside a link to it. */
  def previous(path: Path): Path =
    val file = target(path)
    file.resolveSibling(s"${file.getFileName}.previous")

  private[storage] def target(path: Path): Path =
    Try(WholeFile.target(path)).toOption.flatten.getOrElse(path)

  /** Opens a film file, or its previous copy if it is damaged or missing.
    *
    * @throws IOException if neither can be read; the message names the file
    */
  def open(path: Path): FilmFile =
    header(path) match
      case Right(header) => FilmFile(path, header, path, None)
      case Left(why) =>
        val copy = previous(path)
        header(copy) match
          case Right(header) => FilmFile(path, header, copy, Some(why))
          case Left(_) if !Files.exists(copy) => throw IOException(s"can't read `$path`: $why")
          case Left(other) =>
            throw IOException(s"can't read `$path`: $why; nor its previous copy: $other")

  private def header(path: Path): Either[String, FilmHeader] =
    try
      if !Files.exists(path) then Left("no such file")
      else
        def foreign = ForeignFile.of(path).filter(_.kind != ForeignKind.Film)
        InputFile.obstacle(path).orElse(foreign.map(f => s"it is ${f.what}, not a saved rendering"))
          .toLeft(sound(CheckedFile.read(path, Mark)(FilmHeader.load)))
    catch case e: IOException => Left(reason(e))

  private def reason(e: IOException): String = e match
    case _: EOFException => "it is damaged: values are missing"
    case other => IoReason(other)

  /** Numbers that can't be in a film file: its checksum is right, but it was not written by us. */
  private def sound[A](body: => A): A =
    try body
    catch
      case e: RuntimeException =>
        val message = String.valueOf(e.getMessage).stripPrefix("requirement failed: ")
        throw IOException(s"it is damaged: $message", e)

/** Writes a rendering to a film file, again and again, such that a good copy exists at any moment.
  *
  * @param isGood whether `path` is a good copy, if it exists
  */
final class FilmWriter(path: Path, private var isGood: Boolean = true):
  private var next = Option.empty[NextFile]

  /** Writes the next copy. */
  def write(header: FilmHeader, state: RenderState): Unit =
    abandon()
    val file = NextFile.of(path)
    next = Some(file)
    try
      file.write: channel =>
        CheckedFile.writeTo(channel, FilmFile.Mark): out =>
          header.save(out)
          state.save(out)
    catch
      case e: Throwable =>
        abandon()
        throw e

  /** Replaces the file by the copy written last, once the device has it. */
  def commit(): Unit =
    try
      next.foreach(_.commit(keepPrevious()))
      isGood = true
    finally abandon()

  private def keepPrevious(): Unit =
    val file = FilmFile.target(path)
    if isGood && Files.isRegularFile(file) then NextFile.move(file, FilmFile.previous(path))

  private def abandon(): Unit =
    next.foreach(_.close())
    next = None
