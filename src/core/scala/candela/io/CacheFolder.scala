package candela.io

import java.io.IOException
import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.charset.StandardCharsets.US_ASCII
import java.nio.file.LinkOption.NOFOLLOW_LINKS
import java.nio.file.StandardOpenOption.READ
import java.nio.file.attribute.FileTime
import java.nio.file.attribute.PosixFilePermission.OTHERS_WRITE
import java.nio.file.{Files, Path}
import java.time.Instant

import scala.jdk.CollectionConverters.*
import scala.jdk.OptionConverters.*
import scala.util.{Try, Using}

/** A folder of files that can be made again. Several processes may share it: files are written
  * whole, under names of their content, and may be deleted at any time.
  *
  * Names can be guessed, so a folder that all users can write in is refused, and so is a file that
  * is a link, or of another user than this one, the folder's owner or the system's administrator.
  *
  * @param maxBytes that all files may take; those that were used least recently are deleted
  */
final class CacheFolder(val path: Path, maxBytes: Long):
  import CacheFolder.*

  /** The file of a key, whether it exists or not.
    *
    * @param suffix one of [[CacheFolder.Suffixes]]
    */
  def file(key: String, suffix: String): Path = path.resolve(Sha256.of(key).take(Digits) + suffix)

  /** Notes that a file is used, so that it is not the least recently used. */
  def touch(file: Path): Unit =
    Try(Files.setLastModifiedTime(file, FileTime.from(Instant.now))): Unit

  /** Opens a file to read it.
    *
    * @throws IOException if there is none that can be trusted
    */
  def open(file: Path): FileChannel =
    checkFolder()
    if !isTrusted(file) then throw IOException("it is a link, or of another user")
    FileChannel.open(file, READ, NOFOLLOW_LINKS)

  /** Makes a file.
    *
    * @throws IOException if it can't be written
    */
  def write(file: Path)(body: FileChannel => Unit): Unit =
    Files.createDirectories(path): Unit
    checkFolder()
    // The limit may be less than it was when the files were written
    synchronized(if bytesLeft < 0 then shrink(None))
    WholeFile.write(file, isForced = false, followsLinks = false)(body)
    synchronized:
      bytesLeft -= Files.size(file)
      if bytesLeft < 0 then shrink(Some(file))

  /** Bytes that may be written before the folder is listed again, which takes long for many files:
    * a share of the limit, as other processes write, too.
    */
  private var bytesLeft = -1L

  @volatile private var otherCount = 0

  /** Says that the folder has files of others, if it was listed. */
  def remark: Option[String] = Option.when(otherCount > 0):
    s"the cache folder `$path` has $otherCount files that are not Candela's; they stay, and do " +
      "not count"

  private lazy val owner: Option[String] = Try(Files.getOwner(path).getName).toOption

  /** @throws IOException if all users can write in the folder */
  private def checkFolder(): Unit =
    // Other systems have no such permissions
    val isOpen = Try(Files.getPosixFilePermissions(path).contains(OTHERS_WRITE))
    if isOpen.getOrElse(false) then
      throw IOException("all users can write in it, so its files can't be trusted; " +
        s"`chmod o-w $path` changes that")

  private def isTrusted(file: Path): Boolean =
    def isOfFriend =
      val name = Try(Files.getOwner(file, NOFOLLOW_LINKS).getName).toOption
      // Where the system names no owners, it has none
      name.forall(n => n == Administrator || owner.contains(n) || User.forall(_ == n))
    Files.isRegularFile(file, NOFOLLOW_LINKS) && isOfFriend

  /** Deletes Candela's files if they take more than they may, until there is room for others.
    *
    * @param last the file that stays
    */
  private def shrink(last: Option[Path]): Unit =
    val files = Try(Using.resource(Files.list(path))(_.iterator.asScala.toVector))
    val (ours, others) = files.getOrElse(Vector.empty).partition(isOurs)
    // One that has Candela's name, and not its first bytes, is damaged
    otherCount = others.map(_.getFileName.toString)
      .count(name => !name.startsWith(".candela-") && !FileNames.matches(name))
    val sizes = ours.flatMap: file =>
      Try((file, Files.size(file), Files.getLastModifiedTime(file))).toOption
    val room = maxBytes / UnlistedShare
    var sum = sizes.map(_._2).sum
    if sum > maxBytes then
      for (file, size, _) <- sizes.sortBy(_._3) if sum > maxBytes - room && !last.contains(file) do
        if Try(Files.deleteIfExists(file)).isSuccess then sum -= size
    bytesLeft = Math.min(maxBytes - sum, room)

  /** Whether name and first bytes are those of a file that this class has written. */
  private def isOurs(file: Path): Boolean =
    FileNames.matches(file.getFileName.toString) && isTrusted(file) &&
      Try(Using.resource(FileChannel.open(file, READ, NOFOLLOW_LINKS))(hasMark)).getOrElse(false)

object CacheFolder:
  /** Of files of tiles, of parts of scenes, and of tables of digests. */
  val Tiles = ".tiles"
  val Parts = ".part"
  val Digests = ".digests"
  private val Suffixes = Vector(Tiles, Parts, Digests)

  /** How the text begins that tells what a file is, after the length of the text in 4 bytes. */
  val Mark = "candela "

  /** Hexadecimal digits of a file's name. */
  private val Digits = 40
  private val FileNames =
    s"[0-9a-f]{$Digits}(${Suffixes.map(java.util.regex.Pattern.quote).mkString("|")})".r

  /** The folder is listed after writing one in so many of the bytes that it may have. */
  private val UnlistedShare = 16

  private val Administrator = "root"
  private val User: Option[String] = ProcessHandle.current.info.user.toScala

  private def hasMark(channel: FileChannel): Boolean =
    val bytes = ByteBuffer.allocate(4 + Mark.length)
    while bytes.hasRemaining && channel.read(bytes) >= 0 do ()
    val text = String(bytes.array, 4, Mark.length, US_ASCII)
    text == Mark

  /** Bytes that the files may take, if nobody says. */
  val UsualSize: Long = 20_000_000_000L

  /** The user's, where the system has such a folder: as the launcher's archives. */
  def userFolder(environment: Map[String, String] = sys.env): Option[Path] =
    def absolute(name: String) =
      environment.get(name).filter(_.nonEmpty).flatMap(p => Try(Path.of(p)).toOption)
        .filter(_.isAbsolute)
    val cache = absolute("XDG_CACHE_HOME")
      .orElse(absolute("HOME").map(_.resolve(".cache")))
      .orElse(absolute("LOCALAPPDATA"))
    cache.map(_.resolve("candela").resolve("textures"))
