package candela.render.storage

import java.io.IOException
import java.nio.channels.{FileChannel, OverlappingFileLockException}
import java.nio.file.StandardOpenOption.{CREATE, WRITE}
import java.nio.file.{Files, Path}
import java.nio.file.LinkOption.NOFOLLOW_LINKS

import scala.util.Try

/** The right to write a film file, held by one rendering at a time.
  *
  * It is a lock of the operating system, which ends with the process, however that ends. File
  * systems without locks don't guard the file.
  */
final class FilmLock private (file: Path, channel: FileChannel) extends AutoCloseable:
  def close(): Unit =
    // While it is still locked: no other process can have begun to use it
    val _ = Try(Files.deleteIfExists(file))
    channel.close()

object FilmLock:

  /** Takes the right to write `film`; None if another rendering has it.
    *
    * @throws IOException if the folder can't be written
    */
  def acquire(film: Path): Option[FilmLock] =
    val target = FilmFile.target(film)
    val file = target.resolveSibling(s".${target.getFileName}.lock")
    // A pipe would wait, and a link might lead anywhere
    if Files.exists(file, NOFOLLOW_LINKS) && !Files.isRegularFile(file, NOFOLLOW_LINKS) then
      throw IOException(s"`$file` is not a lock file, but a link, a folder or a pipe")
    val channel = FileChannel.open(file, CREATE, WRITE, NOFOLLOW_LINKS)
    val isOurs =
      try channel.tryLock() != null
      catch
        case _: OverlappingFileLockException => false // another thread of this process
        case _: IOException => true // no locks here
    if !isOurs then
      channel.close()
      None
    else if !Files.exists(file) then
      // Its last owner deleted it after it was opened here
      channel.close()
      acquire(film)
    else Some(FilmLock(file, channel))
