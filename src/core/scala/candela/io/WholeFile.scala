package candela.io

import java.io.IOException
import java.nio.ByteBuffer
import java.nio.channels.{FileChannel, OverlappingFileLockException}
import java.nio.file.*
import java.nio.file.LinkOption.NOFOLLOW_LINKS
import java.nio.file.StandardCopyOption.{ATOMIC_MOVE, REPLACE_EXISTING}
import java.nio.file.StandardOpenOption.{APPEND, CREATE_NEW, WRITE}
import java.nio.file.attribute.BasicFileAttributes
import java.util.Locale
import java.util.concurrent.ConcurrentHashMap

import scala.annotation.tailrec
import scala.util.Try

/** A file that can't be written; the message names it. */
final class WriteError(path: Path, val reason: String)
    extends IOException(s"can't write `$path`: $reason")

/** Writes every file that the program makes: a file is complete or as it was before, even if the
  * program is killed or the disk is full.
  *
  * The target of a symbolic link is replaced, not the link; pipes and devices are written to.
  */
object WholeFile:

  def write(path: Path, bytes: Array[Byte]): Unit = write(path, Vector(ByteBuffer.wrap(bytes)))

  /** Writes what remains in the parts, in order. */
  def write(path: Path, parts: Vector[ByteBuffer]): Unit =
    write(path): channel =>
      for part <- parts do
        while part.hasRemaining do
          // Java copies what it writes to memory outside the heap, all at once
          val next = part.slice(part.position(), Math.min(part.remaining, WrittenAtOnce))
          part.position(part.position() + channel.write(next)): Unit

  /** Lets `body` write the file.
    *
    * @param isForced     whether the device has it when this ends; else it may be damaged if the
    *   machine fails, which its reader must find
    * @param followsLinks whether the target of a link is replaced; else the link itself
    * @throws WriteError if that fails with an IOException
    */
  def write(path: Path, isForced: Boolean = true, followsLinks: Boolean = true)(
      body: FileChannel => Unit
  ): Unit =
    val next = NextFile.of(path, followsLinks)
    try
      next.write(body)
      if isForced then next.commit() else next.replace()
    finally next.close()

  /** Why the file can't be written, as far as it can be told without writing. */
  def obstacle(path: Path): Option[String] =
    try
      target(path) match
        case None => Option.unless(Files.isWritable(path))("no write permission")
        case Some(file) => obstacleOf(file)
    catch case e: IOException => Some(reason(e))

  /** Why a file can't be opened beside it, where permissions promise that it can, as in `/proc`:
    * one is opened, and deleted.
    */
  def refusal(path: Path): Option[String] =
    try
      if target(path).nonEmpty then NextFile.of(path).close()
      None
    catch
      case e: IOException => Some(reason(e))

  private def obstacleOf(file: Path): Option[String] =
    val folder = Option(file.toAbsolutePath.getParent)
    if Files.isDirectory(file) then Some("it is a folder")
    else if !folder.exists(Files.isDirectory(_)) then
      Some(s"no such folder: `${folder.getOrElse(file)}`")
    else if !folder.exists(Files.isWritable) then Some("no write permission in its folder")
    else
      // Of names that the file system can't hold, such as long ones, it knows no attributes.
      try
        val _ = Files.readAttributes(file, classOf[BasicFileAttributes])
        Option.unless(Files.isWritable(file))("it is write-protected")
      catch case _: NoSuchFileException => None

  /** Where the file is, or will be, after all links; None if it is a pipe or a device.
    *
    * @throws IOException if the links are a circle
    */
  def target(path: Path): Option[Path] = followed(path, MaxLinks)
    .filterNot(file => Files.exists(file) && !Files.isRegularFile(file) && !Files.isDirectory(file))

  /** Whether it is a pipe, where the system tells: writing waits for its reader. */
  def isPipe(path: Path): Boolean =
    Try(Files.getAttribute(path, "unix:mode")).toOption.exists:
      case mode: Integer => (mode & 0xf000) == 0x1000
      case _ => false

  @tailrec
  private def followed(path: Path, left: Int): Option[Path] =
    if !Files.isSymbolicLink(path) then Some(path)
    // What the shell has opened, such as /dev/stdout, may be a file; but it must not be replaced.
    else if Opened.exists(path.toAbsolutePath.startsWith) then None
    else if left == 0 then throw IOException("too many levels of symbolic links")
    else followed(path.resolveSibling(Files.readSymbolicLink(path)), left - 1)

  private val Opened = Vector("/proc", "/dev/fd").map(Path.of(_))

  /** In bytes. */
  private val WrittenAtOnce = 1 << 20

  /** As Linux. */
  private val MaxLinks = 40

  /** The reason of a failure, without the file name. */
  def reason(e: IOException): String = e match
    case w: WriteError => w.reason
    case _: AccessDeniedException => "no write permission"
    case _: NoSuchFileException => "no such folder"
    case f: FileSystemException if f.getReason != null => f.getReason
    case other => Option(other.getMessage).getOrElse(other.getClass.getSimpleName)

/** The next version of a file, which is not yet in its place.
  *
  * @param target    the file to replace; None: `channel` writes to it directly
  * @param temporary beside the target, and locked, which tells others that it is in use
  */
final class NextFile private (
    path: Path,
    target: Option[Path],
    temporary: Path,
    channel: FileChannel
) extends AutoCloseable:

  def write(body: FileChannel => Unit): Unit = named(body(channel))

  /** Replaces the file, once the device has the next version.
    *
    * @param before done between these two
    */
  def commit(before: => Unit = ()): Unit = named:
    if target.nonEmpty then channel.force(true)
    before
    replace()
    for file <- target do
      // The folder's entry, where the system can force it to the device
      val _ = Try:
        val folder = FileChannel.open(file.toAbsolutePath.getParent, StandardOpenOption.READ)
        try folder.force(true)
        finally folder.close()

  /** Replaces the file. */
  private[candela] def replace(): Unit = named:
    // Still locked: no other run takes it for a left one
    for file <- target do NextFile.move(temporary, file)

  /** Gives up what has not been committed. */
  def close(): Unit =
    val _ = Try(channel.close())
    if target.nonEmpty then
      val _ = Try(Files.deleteIfExists(temporary))
      val _ = NextFile.open.remove(temporary)

  private def named(body: => Unit): Unit =
    try body
    catch
      case e: WriteError => throw e
      case e: IOException => throw WriteError(path, WholeFile.reason(e))

object NextFile:
  /** Temporary files of this process. */
  private val open = ConcurrentHashMap.newKeySet[Path]()

  /** Deletes what is not complete, and ends the process before another file is begun. */
  def giveUp(end: => Unit): Unit = open.synchronized:
    open.forEach(file => Try(Files.deleteIfExists(file)): Unit)
    end

  /** Opens the next version of a file.
    *
    * @param followsLinks whether the target of a link is replaced; else the link itself
    * @throws WriteError if it can't be opened
    */
  def of(path: Path, followsLinks: Boolean = true): NextFile =
    try
      val isReplaced = !followsLinks && Files.isSymbolicLink(path)
      for why <- WholeFile.obstacle(path) if !isReplaced do throw WriteError(path, why)
      val target = if isReplaced then Some(path) else WholeFile.target(path)
      target match
        case None => NextFile(path, None, path, FileChannel.open(path, WRITE, APPEND))
        case Some(file) =>
          removeLeft(file)
          val unique = s"${ProcessHandle.current.pid}-${System.nanoTime}"
          val temporary = file.resolveSibling(s"${beginning(file)}$unique.tmp")
          val channel = open.synchronized:
            val created = FileChannel.open(temporary, CREATE_NEW, WRITE)
            open.add(temporary): Unit
            created
          val _ = Try(channel.tryLock())
          val _ = Try(Files.setPosixFilePermissions(temporary, Files.getPosixFilePermissions(file)))
          NextFile(path, target, temporary, channel)
    catch
      case e: WriteError => throw e
      // The folder is there
      case _: NoSuchFileException => throw WriteError(path, "no file can be created in its folder")
      case e: IOException => throw WriteError(path, WholeFile.reason(e))

  /** Moves a file in place of another one. */
  def move(from: Path, to: Path): Unit =
    try
      val _ = Files.move(from, to, ATOMIC_MOVE)
    catch
      case _: AtomicMoveNotSupportedException =>
        val _ = Files.move(from, to, REPLACE_EXISTING)

  /** Short, because the file's own name may be as long as the file system allows. */
  private def beginning(file: Path): String =
    ".candela-%08x-".formatLocal(Locale.ROOT, file.getFileName.toString.hashCode)

  /** Deletes what killed runs have left of this file: nobody has locked it. */
  private def removeLeft(file: Path): Unit =
    val _ = Try:
      val files = Files.newDirectoryStream(
        file.toAbsolutePath.getParent,
        path => isLeft(path.getFileName.toString, path, beginning(file))
      )
      try files.forEach(removeUnlocked)
      finally files.close()

  private def isLeft(name: String, path: Path, beginning: String): Boolean =
    // A pipe of this name would wait, and a link might lead anywhere
    val isOurs = name.startsWith(beginning) && name.endsWith(".tmp") &&
      Files.isRegularFile(path, NOFOLLOW_LINKS)
    isOurs && {
      val owner = name.drop(beginning.length).takeWhile(_.isDigit).toLongOption
      owner.flatMap(pid => Option(ProcessHandle.of(pid).orElse(null))).forall: process =>
        // Another process may have had the number, even ours
        val start = process.info.startInstant
        start.isPresent && Files.getLastModifiedTime(path).toInstant.isBefore(start.get)
    }

  private def removeUnlocked(path: Path): Unit =
    val _ = Try:
      val channel = FileChannel.open(path, WRITE, NOFOLLOW_LINKS)
      try
        // Where there are no locks: the process has ended
        if isFree(channel, withoutLocks = true) then
          val _ = Files.deleteIfExists(path)
      finally channel.close()

  /** Whether nobody has locked the file.
    *
    * @param withoutLocks the answer where the file system has none
    */
  private[candela] def isFree(channel: FileChannel, withoutLocks: Boolean): Boolean =
    try channel.tryLock() != null
    catch
      case _: OverlappingFileLockException => false // another thread of this process
      case _: IOException => withoutLocks
