package candela.io

import java.io.{
  BufferedInputStream, ByteArrayInputStream, FilterInputStream, InputStream, IOException
}
import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.attribute.{BasicFileAttributes, FileTime}
import java.nio.file.{Files, InvalidPathException, Path, StandardOpenOption}
import java.util.concurrent.TimeUnit.NANOSECONDS

import scala.util.{Try, Using}

/** A file that exists, to be read. What a scene names is opened by its [[SceneFolder]]; `named` is
  * for what users name.
  *
  * @param path  as named, for messages
  * @param location where it is opened
  * @param gate  counts what is read
  * @param isShown whether messages may quote it
  * @param reads receives the digest of what is read
  * @param content in memory, of a file within another one, which was counted
  */
final class InputFile private[candela] (
    val path: Path,
    private val location: Path,
    gate: Long => Unit,
    mayBePipe: Boolean,
    shown: => Boolean,
    reads: ReadFiles = ReadFiles(),
    private val content: Option[ByteBuffer] = None
):
  lazy val isShown: Boolean = shown

  /** A file that has an end: what the kernel makes as it is read might have none. */
  def isRegular: Boolean =
    content.nonEmpty || Files.isRegularFile(location) && obstacle.isEmpty

  /** Why it is not to be opened, unless its user named it as a stream. */
  private[candela] def obstacle: Option[String] =
    if content.nonEmpty then None else InputFile.obstacle(location)
  def isFolder: Boolean = Files.isDirectory(location)

  /** Whether it is a pipe that may be read, once. */
  def isPipe: Boolean =
    mayBePipe && Files.exists(location) && InputFile.endless(location).nonEmpty && !isFolder
  def size: Long = content.fold(Files.size(location))(_.remaining)
  def isSame(other: InputFile): Boolean = location == other.location || identity == other.identity

  /** Which file it is, whatever its name; asked for once. */
  private lazy val identity: AnyRef = content.getOrElse:
    val key = attributes.fileKey
    if key != null then key else location.toRealPath()

  /** Counts bytes that are unpacked from the file. */
  def unpacks(bytes: Long): Unit = gate(bytes)

  /** All bytes. A file of 2 GB or more is an OutOfMemoryError. */
  def bytes(): Array[Byte] = content match
    case Some(part) => InputFile.read(part, part.remaining)
    case None =>
      gate(Files.size(readable))
      val content = Files.readAllBytes(readable)
      if isRegular then note(Sha256.of(ByteBuffer.wrap(content)))
      content

  /** The file as Latin-1, in which no byte is wrong. */
  def text(): String = String(bytes(), ISO_8859_1)

  def lines(): Vector[String] = text().linesIterator.toVector

  /** Words between white space, without comments, which begin with `#`. */
  def words(): Vector[String] =
    lines().flatMap(_.takeWhile(_ != '#').split("\\s+")).filter(_.nonEmpty)

  def stream(): InputStream = if content.nonEmpty then again() else counted()

  private def counted(): InputStream =
    val plain = Files.newInputStream(readable)
    // The rest of a pipe may never come
    val raw = if isRegular then Digesting(plain, Sha256.Bytes(), note) else plain
    BufferedInputStream(Gated(raw, gate))

  /** As `stream`, for those that note a digest of what they read from it. */
  private[candela] def undigested(): InputStream =
    if content.nonEmpty then again()
    else BufferedInputStream(Gated(Files.newInputStream(readable), gate))

  /** Its first bytes, to look at in passing: they are not counted, since they are read again. */
  def beginning(most: Int): Array[Byte] = Using.resource(again())(_.readNBytes(most))

  /** Its bytes, not counted: who has read it reads it again.
    *
    * @throws IOException if it can't be read
    */
  def again(): InputStream = content match
    case Some(part) => ByteArrayInputStream(InputFile.read(part, part.remaining))
    case None => Files.newInputStream(readable)

  /** Digest of its content. Its bytes are not counted, as they are read again.
    *
    * @throws IOException if it can't be read
    */
  def digest(): String =
    val sum = Sha256.ofAll(again())
    note(sum)
    sum

  /** What is read of its content is what has this digest. */
  private[candela] def note(digest: String): Unit =
    if content.isEmpty then reads.note(path, digest)

  /** Changes when the file changes; None if the system has no such stamp, or if the file has
    * changed so recently that another change would go unnoticed.
    */
  private[candela] def stamp(rest: Long = FileStamp.RestMillis): Option[FileStamp] =
    if content.isEmpty then FileStamp.of(location, rest) else None

  /** Where it is, whatever the user's folder. */
  private[candela] def absolutePath: Path = location.toAbsolutePath.normalize

  /** Tells whether the file is surely as it is now. */
  def watch(): () => Boolean = if content.nonEmpty then () => true else watched()

  private def watched(): () => Boolean =
    val isTimed = FileDigests.isTimed(absolutePath.getParent)
    val current = stamp().filter(_ => isTimed)
    () => current.nonEmpty && stamp() == current

  /** In memory as the system sees fit. Its whole size is counted. */
  def map(): ByteBuffer = content.fold(mapped())(_.duplicate)

  private def mapped(): ByteBuffer = Using.resource(channel()): channel =>
    if channel.size > Int.MaxValue then throw IOException("larger than 2 GB")
    val content = channel.map(FileChannel.MapMode.READ_ONLY, 0, channel.size)
    note(Sha256.of(content.duplicate))
    content

  /** For reading. Its whole size is counted. What is read is not digested: `digest` does that. */
  def channel(): FileChannel =
    if content.nonEmpty then throw IOException("it is within another file")
    val opened = FileChannel.open(readable, StandardOpenOption.READ)
    try
      gate(opened.size)
      opened
    catch
      case e: Throwable =>
        opened.close()
        throw e

  /** A word of the file, for messages: files beside the scene's may be none of its. */
  def quoted(word: String): String = if isShown then s"`$word`" else "text that is not shown"

  override def toString: String = path.toString

  /** Pipes and devices might never end. */
  private def readable: Path =
    val hindrance =
      if mayBePipe && !isFolder then InputFile.pointer(location) else obstacle
    for why <- hindrance do throw IOException(why)
    location

  private def attributes = Files.readAttributes(location, classOf[BasicFileAttributes])

object InputFile:
  private val Folder = "it is a folder"

  /** A file within another one.
    *
    * @param path in messages
    */
  private[io] def part(path: Path, content: ByteBuffer): InputFile =
    InputFile(path, path, _ => (), mayBePipe = false, shown = true, content = Some(content))

  private def read(part: ByteBuffer, count: Int): Array[Byte] =
    val bytes = new Array[Byte](count)
    val _ = part.get(part.position(), bytes)
    bytes

  /** Why an existing file is not to be opened, unless its user named it as a stream. */
  def obstacle(file: Path): Option[String] = endless(file).orElse(pointer(file))

  /** A small text that Git has in place of a large file until it is fetched. */
  private def pointer(file: Path): Option[String] =
    def start = Using.resource(Files.newInputStream(file))(_.readNBytes(PointerMark.length))
    val isPointer =
      Try(Files.isRegularFile(file) && Files.size(file) <= MaxPointerSize &&
        String(start, ISO_8859_1) == PointerMark).getOrElse(false)
    Option.when(isPointer)("it is a pointer of Git LFS, not the file itself: run `git lfs pull`")

  private val PointerMark = "version https://git-lfs.github.com/spec/"

  /** In bytes, by the specification of Git LFS. */
  private val MaxPointerSize = 1024

  /** Why reading might never end. */
  private def endless(file: Path): Option[String] =
    Try(Files.readAttributes(file, classOf[BasicFileAttributes])).toOption.flatMap: a =>
      if a.isDirectory then Some(Folder)
      else if !a.isRegularFile then Some("it is a pipe or a device, not a regular file")
      else if !hasSize(a.size) && Try(file.toRealPath()).toOption.exists(ofKernel) then
        Some("it is generated by the kernel, not a regular file")
      else None

  /** Virtual files of the kernel have no size, or an absurd one. */
  private def hasSize(size: Long) = size > 0 && size < (1L << 45)

  private def ofKernel(file: Path) = KernelFolders.exists(file.startsWith)

  private val KernelFolders = Vector("/proc", "/sys").map(Path.of(_))

  /** A file that the user has named. */
  def named(path: Path): InputFile = InputFile(path, path, _ => (), mayBePipe = true, shown = true)

  /** A file that was read before, by its name in messages. */
  def again(name: String): Option[InputFile] =
    try
      Some(Path.of(name)).filter(Files.isRegularFile(_)).map: path =>
        InputFile(path, path, _ => (), mayBePipe = false, shown = true)
    catch case _: InvalidPathException => None

/** Attributes of a file that differ if the file was changed or replaced.
  *
  * @param words size; when it was modified, and when its content or its attributes were changed,
  *              which no program can set, in nanoseconds; device and number
  */
private[candela] final case class FileStamp(words: String)

private[candela] object FileStamp:
  /** A second write in memory (`mmap`) changes no time until the kernel has written the first one
    * to disk, which Linux does within 35 seconds. In milliseconds.
    */
  val RestMillis = 120_000L

  /** @param rest milliseconds since its last change, at least */
  def of(file: Path, rest: Long = RestMillis): Option[FileStamp] = Try:
    val attributes = Files.readAttributes(file, "unix:size,lastModifiedTime,ctime,dev,ino")
    def time(name: String) = attributes.get(name).asInstanceOf[FileTime]
    val times = Seq("lastModifiedTime", "ctime").map(time(_).to(NANOSECONDS))
    val stamp =
      FileStamp((attributes.get("size") +: times :+ attributes.get("dev") :+ attributes.get(
        "ino"
      )).mkString(" "))
    Option.when(System.currentTimeMillis - time("ctime").toMillis >= rest)(stamp)
  .toOption.flatten

/** Counts the bytes read. */
private final class Gated(in: InputStream, gate: Long => Unit) extends FilterInputStream(in):
  override def read(): Int =
    val byte = in.read()
    if byte >= 0 then gate(1)
    byte

  override def read(into: Array[Byte], from: Int, length: Int): Int =
    val n = in.read(into, from, length)
    if n > 0 then gate(n)
    n

  /** None of a pipe, where JDK 17's streams of files throw "Illegal seek". */
  override def available(): Int =
    try in.available()
    catch case _: IOException => 0
