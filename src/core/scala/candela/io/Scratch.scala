package candela.io

import java.nio.channels.FileChannel
import java.nio.file.LinkOption.NOFOLLOW_LINKS
import java.nio.file.StandardOpenOption.{CREATE_NEW, WRITE}
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** A folder of this process for files that are not to stay, in the system's folder for such.
  *
  * It is locked as long as the process lives. The next one removes what killed ones have left: no
  * folders of other users or programs, and none that a living process has.
  */
final class Scratch private (val folder: Path, lock: FileChannel) extends AutoCloseable:
  def close(): Unit =
    Scratch.delete(folder, keepsLock = true)
    lock.close()
    Scratch.delete(folder, keepsLock = false)

object Scratch:
  private val Prefix = "candela-scratch-"
  private val LockName = "lock"

  /** Of this process's folders. Their locks must not be opened again: a process that closes a file
    * loses all of its locks on it.
    */
  private val OwnPrefix = s"$Prefix${ProcessHandle.current.pid}-"

  /** A folder that has no lock yet may be about to get one, for milliseconds. */
  private val Doubt = 3_600_000L

  /** @throws java.io.IOException if no folder can be made */
  def create(): Scratch =
    val folder = Files.createTempDirectory(OwnPrefix)
    val lock = FileChannel.open(folder.resolve(LockName), CREATE_NEW, WRITE)
    val _ = Try(lock.tryLock())
    for in <- Option(folder.getParent) do
      val _ = Try(removeLeft(in, Files.getOwner(folder)))
    Scratch(folder, lock)

  private def removeLeft(in: Path, owner: AnyRef): Unit =
    Using.resource(Files.newDirectoryStream(in, s"$Prefix*")): folders =>
      for folder <- folders.asScala do
        val _ = Try:
          val isUsers = Files.isDirectory(folder, NOFOLLOW_LINKS) &&
            Files.getOwner(folder, NOFOLLOW_LINKS) == owner
          val isOwn = folder.getFileName.toString.startsWith(OwnPrefix)
          if isUsers && !isOwn then removeUnlocked(folder)

  private def removeUnlocked(folder: Path): Unit =
    val lock = folder.resolve(LockName)
    if Files.isRegularFile(lock, NOFOLLOW_LINKS) then
      Using.resource(FileChannel.open(lock, WRITE, NOFOLLOW_LINKS)): channel =>
        // Where there are no locks, nothing is known
        if NextFile.isFree(channel, withoutLocks = false) then delete(folder, keepsLock = false)
    else
      val age = System.currentTimeMillis - Files.getLastModifiedTime(folder).toMillis
      if age > Doubt then delete(folder, keepsLock = false)

  /** Deletes links without following them. */
  private def delete(folder: Path, keepsLock: Boolean): Unit =
    val _ = Try:
      val paths = Using.resource(Files.walk(folder))(_.iterator.asScala.toVector)
      def isKept(file: Path) = keepsLock && (file == folder || file == folder.resolve(LockName))
      for file <- paths.reverse if !isKept(file) do Files.deleteIfExists(file): Unit
