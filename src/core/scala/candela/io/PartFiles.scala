package candela.io

import candela.base.Version
import java.io.IOException

/** How things of a kind are written to files, and read from them.
  *
  * @param name   tells the kind and the version of its form
  * @param suffix of the files' names
  */
abstract class PartForm[A](val name: String, val suffix: String = CacheFolder.Parts):
  /** Bytes of the file, about. */
  def size(thing: A): Long

  def write(thing: A, out: CheckedOutput): Unit

  /** @throws IOException if the file ends early */
  def read(in: CheckedInput): A

/** Parts of scenes, in files of a cache folder, by key. Safe for threads and processes. */
final class PartFiles(folder: CacheFolder):
  @volatile private var obstacle: Option[String] = None
  private var isTold = false

  /** Why files can't be written, if that was not told before. */
  def trouble(): Option[String] = synchronized:
    val message = obstacle.filterNot(_ => isTold)
    if message.nonEmpty then isTold = true
    message

  /** As of the folder. */
  def remark: Option[String] = folder.remark

  /** The value in the file of this key; None if the file is missing or damaged. */
  def read[A](form: PartForm[A], key: String): Option[A] =
    val file = folder.file(mark(form, key), form.suffix)
    try
      val value = CheckedFile.readOnce(folder.open(file), mark(form, key)): in =>
        val parsed = form.read(in)
        if !in.isAtEnd then throw IOException("it has surplus data")
        parsed
      folder.touch(file)
      Some(value)
    catch case _: IOException => None

  /** Writes the file of a key, if the thing is large enough. After a failure nothing is written.
    *
    * @param isNeeded whether a failure is to be told
    */
  def write[A](form: PartForm[A], key: String, thing: A, isNeeded: Boolean = true): Unit =
    if obstacle.isEmpty && form.size(thing) >= PartFiles.MinBytes then
      val words = mark(form, key)
      try
        folder.write(folder.file(words, form.suffix)): channel =>
          CheckedFile.writeTo(channel, words)(form.write(thing, _))
      catch
        case e: WriteError => if isNeeded then obstacle = Some(e.getMessage)
        case e: IOException =>
          if isNeeded then obstacle = Some(s"can't write to `${folder.path}`: ${IoReason(e)}")

  /** What is made by another version may differ. */
  private def mark(form: PartForm[?], key: String) =
    s"${CacheFolder.Mark}${form.name} $key ${Version.build}"

object PartFiles:
  /** Smaller things are computed as fast as their files are read. */
  val MinBytes: Long = 1 << 16
