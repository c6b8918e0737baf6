package candela.base

import java.nio.channels.FileChannel
import java.nio.file.attribute.FileTime
import java.nio.file.{Files, Path}
import java.time.Instant

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** A folder of files that can be made again. Several processes may share it: files are written
  * whole, under names of their content, and may be deleted at any time.
  *
  * @param most bytes that all files may take; those that were used least recently are deleted
  */
final class CacheFolder(val path: Path, most: Long):

  /** The file of a key, whether it exists or not.
    *
    * @param suffix one of [[CacheFolder.Suffixes]]
    */
  def file(key: String, suffix: String): Path = path.resolve(Sha256.of(key).take(40) + suffix)

  /** Notes that a file is used, so that it is not the least recently used. */
  def use(file: Path): Unit =
    Try(Files.setLastModifiedTime(file, FileTime.from(Instant.now))): Unit

  /** The limit may be less than it was when the files were written. */
  private lazy val isShrunk: Unit = shrink(None)

  /** Makes a file.
    *
    * @throws java.io.IOException if it can't be written
    */
  def write(file: Path)(body: FileChannel => Unit): Unit =
    Files.createDirectories(path): Unit
    isShrunk
    WholeFile.write(file, isForced = false)(body)
    shrink(Some(file))

  /** Deletes files until the others take no more than they may.
    *
    * @param last the file that stays
    */
  private def shrink(last: Option[Path]): Unit =
    val all = Try:
      Using.resource(Files.list(path)): files =>
        files.iterator.asScala.filter(f =>
          CacheFolder.Suffixes.exists(f.toString.endsWith)
        ).toVector
    val known = all.getOrElse(Vector.empty).flatMap: file =>
      Try((file, Files.size(file), Files.getLastModifiedTime(file))).toOption
    var sum = known.map(_._2).sum
    for (file, size, _) <- known.sortBy(_._3) if sum > most && !last.contains(file) do
      if Try(Files.deleteIfExists(file)).isSuccess then sum -= size

object CacheFolder:
  /** Of files of tiles, of parts of scenes, and of tables of digests. */
  val Tiles = ".tiles"
  val Parts = ".part"
  val Digests = ".digests"
  private val Suffixes = Vector(Tiles, Parts, Digests)

  /** Bytes that the files may take, if nobody says. */
  val UsualSize: Long = 20_000_000_000L

  /** The user's, where the system has such a folder: as the launcher's archives. */
  def usual(environment: Map[String, String] = sys.env): Option[Path] =
    def absolute(name: String) =
      environment.get(name).filter(_.nonEmpty).flatMap(p => Try(Path.of(p)).toOption)
        .filter(_.isAbsolute)
    val cache = absolute("XDG_CACHE_HOME")
      .orElse(absolute("HOME").map(_.resolve(".cache")))
      .orElse(absolute("LOCALAPPDATA"))
    cache.map(_.resolve("candela").resolve("textures"))
