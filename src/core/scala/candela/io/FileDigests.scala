package candela.io

import java.nio.file.{Files, Path}
import java.util.Locale
import java.util.concurrent.ConcurrentHashMap

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** Digests of files, which are remembered while the files are not touched: by this process, and in
  * cached files for later ones, a table for each folder. Safe for threads.
  *
  * @param rest milliseconds that a file must not have changed for
  */
final class FileDigests(files: Option[PartFiles], rest: Long = FileStamp.RestMillis):
  import FileDigests.*

  private val folders = ConcurrentHashMap[Path, Table]()

  /** The digest of a file, which `make` makes if it is not known.
    *
    * @throws java.io.IOException if the file can't be read
    */
  def apply(file: InputFile)(make: => String): String =
    val path = file.absolutePath
    val name = path.getFileName.toString
    val table = folders.computeIfAbsent(path.getParent, f => Table(written(f), isTimed(f)))
    val initialStamp = file.stamp(rest).filter(_ => table.isTimed)
    val digest = initialStamp.flatMap(table.lookup(name, _)).getOrElse:
      val computed = make
      for stamp <- initialStamp if file.stamp(rest).contains(stamp) do
        table.record(name, stamp, computed)
      computed
    file.note(digest)
    digest

  /** Writes what is new for later processes. */
  def save(): Unit =
    for store <- files do
      folders.forEach: (folder, table) =>
        for rows <- table.drain() do
          // Another may have written some since
          val merged = written(folder) ++ rows
          val existing = merged.filter((name, _) => isThere(folder, name))
          store.write(TableForm, folder.toString, existing, isNeeded = false)

  private def written(folder: Path): Rows =
    files.flatMap(_.read(TableForm, folder.toString)).getOrElse(Map.empty)

object FileDigests:
  /** File systems whose kernel sets the times of change by its own clock, also if a file is written
    * in memory (`mmap`). On others, such as FAT and tmpfs, a digest may outlive its file.
    */
  private val Timed = Set("ext2", "ext3", "ext4", "xfs", "btrfs", "f2fs")

  private[candela] def isTimed(folder: Path): Boolean =
    Try(Files.getFileStore(folder).`type`).toOption.exists(t => Timed(t.toLowerCase(Locale.ROOT)))

  /** Names that another process wrote may be none here. */
  private def isThere(folder: Path, name: String): Boolean =
    Try(Files.exists(folder.resolve(name))).getOrElse(false)

  /** Stamp and digest of each file, by its name. */
  private[candela] type Rows = Map[String, (FileStamp, String)]

  private final class Table(initial: Rows, val isTimed: Boolean):
    private val rows = ConcurrentHashMap[String, (FileStamp, String)](initial.asJava)
    private val fresh = ConcurrentHashMap.newKeySet[String]()
    @volatile private var isNew = false

    def lookup(name: String, stamp: FileStamp): Option[String] =
      for (same, digest) <- Option(rows.get(name)) if same == stamp yield digest

    def record(name: String, stamp: FileStamp, digest: String): Unit =
      rows.put(name, (stamp, digest)): Unit
      fresh.add(name): Unit
      isNew = true

    /** Rows that this process has made, if any was made since they were taken last. */
    def drain(): Option[Rows] = Option.when(isNew):
      isNew = false
      fresh.asScala.iterator.map(n => n -> rows.get(n)).toMap

  private[candela] object TableForm extends PartForm[Rows]("digests 1", CacheFolder.Digests):
    /** Written however small: it stands for reading all of the files. */
    def size(rows: Rows): Long = PartFiles.MinBytes

    def write(rows: Rows, out: CheckedOutput): Unit =
      out.int(rows.size)
      for
        (name, (stamp, digest)) <- rows.toVector.sortBy(_._1);
        word <- Seq(name, stamp.words, digest)
      do out.text(word)

    def read(in: CheckedInput): Rows =
      Vector.fill(in.count(bytes = 12))((in.text(), (FileStamp(in.text()), in.text()))).toMap
