package candela.io

import java.io.IOException
import java.lang.ref.SoftReference
import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.AtomicInteger

/** Keeps what the scenes of a process have in common, by its content, so that it is made once:
  * frames of a sequence, or many views of one scene. What is kept is immutable. Safe for threads.
  *
  * Large things of some kinds may also be kept in files, for other processes.
  *
  * It has what the scene before the latest has used, or the latest itself, and gives that up where
  * the JVM lacks memory.
  */
final class Keep private (val isKeeping: Boolean, files: Option[PartFiles], rest: Long):
  import Keep.*

  private val things = ConcurrentHashMap[(Shelf[?], String), Kept]()
  private val digests = FileDigests(files, rest)
  private val scenes = AtomicInteger()

  /** Whether some is kept in files. */
  def isFiled: Boolean = files.nonEmpty

  /** Begins another scene. */
  def startScene(): Unit =
    val latest = scenes.incrementAndGet()
    val _ = things.values.removeIf(k => k.isGone || k.last < latest - 1)

  /** The cached value of this key, or that of `make`.
    *
    * @param key identifies all inputs of `make`
    */
  def apply[A <: AnyRef](shelf: Shelf[A], key: => String)(make: => A): A =
    if !isKeeping then make
    else
      val name = key
      lookup(shelf, name).getOrElse:
        val created = make
        insert(shelf, name, created)
        created

  def lookup[A <: AnyRef](shelf: Shelf[A], key: String): Option[A] =
    remembered(shelf, key).orElse:
      for
        store <- files; form <- shelf.form
        found <- store.read(form, key)
      yield
        remember(shelf, key, found)
        found

  private def remembered[A <: AnyRef](shelf: Shelf[A], key: String): Option[A] =
    Option(things.get((shelf, key))).flatMap: kept =>
      kept.last = scenes.get
      Option(kept.value.get).map(_.asInstanceOf[A]) // what was put on this shelf

  private def remember[A <: AnyRef](shelf: Shelf[A], key: String, value: A): Unit =
    things.put((shelf, key), Kept(SoftReference(value), scenes.get)): Unit

  def insert[A <: AnyRef](shelf: Shelf[A], key: String, value: A): Unit =
    if isKeeping then
      remember(shelf, key, value)
      for store <- files; form <- shelf.form do store.write(form, key, value)

  /** Writes to files what is known of the scene's files.
    *
    * @return why files can't be written, if that was not told before
    */
  def save(): Option[String] =
    digests.save()
    files.flatMap(_.trouble())

  /** As of the folder of files. */
  def remark: Option[String] = files.flatMap(_.remark)

  /** As `apply`, of what is made from a file, and in which way.
    *
    * @return also the file's digest, unless nothing is kept or the file was written meanwhile
    */
  def ofFile[A <: AnyRef](shelf: Shelf[A], file: InputFile, way: String)(
      make: => A
  ): (A, Option[String]) =
    val initialDigest = content(file)
    initialDigest.flatMap(digest => lookup(shelf, s"$digest $way")) match
      case Some(known) => (known, initialDigest)
      case None =>
        val created = make
        val stableDigest = initialDigest.filter(_ => content(file) == initialDigest)
        for digest <- stableDigest do insert(shelf, s"$digest $way", created)
        (created, stableDigest)

  /** None also of a file that can't be read, which its reader will say. */
  private def content(file: InputFile): Option[String] =
    try Option.when(isKeeping)(digest(file))
    catch case _: IOException => None

  /** The digest of a file, which is remembered while the file is not touched.
    *
    * @throws IOException if it can't be read
    */
  def digest(file: InputFile): String =
    if isKeeping then digests(file)(file.digest()) else file.digest()

object Keep:
  /** @param files also keep large things
    * @param rest  milliseconds after which the times of files are trusted
    */
  def apply(files: Option[PartFiles] = None, rest: Long = FileStamp.RestMillis): Keep =
    new Keep(true, files, rest)

  /** Keeps nothing. */
  val Nothing: Keep = new Keep(false, None, FileStamp.RestMillis)

  /** A cache of values of one kind, compared by identity.
    *
    * @param form of their files, if they may be kept in files
    */
  final class Shelf[A <: AnyRef](val form: Option[PartForm[A]] = None)

  /** @param last the scene that used it last */
  private final class Kept(val value: SoftReference[AnyRef], @volatile var last: Int):
    def isGone: Boolean = value.get == null
