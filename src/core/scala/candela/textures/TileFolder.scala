package candela.textures

import java.nio.file.{Files, Path}
import java.nio.file.attribute.FileTime
import java.time.Instant

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

import candela.base.{Sha256, WholeFile}

/** The folder of files of tiles. Several processes may share it: files are written whole, under
  * names of their content, and may be deleted at any time.
  *
  * @param most bytes that the files may take; those that were used least recently are deleted
  */
final class TileFolder(val path: Path, most: Long):
  import TileFolder.*

  private def file(key: String): Path =
    path.resolve(Sha256.of(key).take(40) + Suffix)

  /** The file of this key, if there is one and it is undamaged as far as its header tells. */
  private[textures] def open(key: String): Option[TileFile] =
    val place = file(key)
    val opened = TileFile.open(place, key)
    if opened.nonEmpty then
      // So that it is not the least recently used
      Try(Files.setLastModifiedTime(place, FileTime.from(Instant.now))): Unit
    opened

  /** Makes the file of a key.
    *
    * @throws IOException if it can't be written
    */
  private[textures] def write(header: TileHeader, levels: Array[Texels]): Unit =
    Files.createDirectories(path): Unit
    val place = file(header.key)
    WholeFile.write(place, isForced = false)(TileFile.write(_, header, levels))
    shrink(place)

  /** Deletes files until the others take no more than they may.
    *
    * @param last the file that stays
    */
  private def shrink(last: Path): Unit =
    val all = Try:
      Using.resource(Files.list(path)): files =>
        files.iterator.asScala.filter(_.toString.endsWith(Suffix)).toVector
    val known = all.getOrElse(Vector.empty).flatMap: file =>
      Try((file, Files.size(file), Files.getLastModifiedTime(file))).toOption
    var sum = known.map(_._2).sum
    for (file, size, _) <- known.sortBy(_._3) if sum > most && file != last do
      if Try(Files.deleteIfExists(file)).isSuccess then sum -= size

object TileFolder:
  private val Suffix = ".tiles"

  /** The user's, where the system has such a folder: as the launcher's archives. */
  def usual(environment: Map[String, String] = sys.env): Option[Path] =
    def absolute(name: String) =
      environment.get(name).filter(_.nonEmpty).flatMap(p => Try(Path.of(p)).toOption)
        .filter(_.isAbsolute)
    val cache = absolute("XDG_CACHE_HOME")
      .orElse(absolute("HOME").map(_.resolve(".cache")))
      .orElse(absolute("LOCALAPPDATA"))
    cache.map(_.resolve("candela").resolve("textures"))
