package candela.io

import candela.diagnostics.{Allowance, Code, Refusal, SourcePos, Suggest}
import java.nio.ByteBuffer
import java.nio.file.{Files, InvalidPathException, LinkOption, Path}
import java.util.concurrent.ConcurrentHashMap

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** The folder of a scene: the one door through which files are opened that the scene names.
  *
  * @param path  what names are relative to
  * @param guard decides what may be opened
  * @param parts contents of files within the scene's own, by name
  */
final class SceneFolder private (
    val path: Path,
    guard: FileGuard,
    parts: Map[String, ByteBuffer] = Map.empty
):

  def isConfined: Boolean = guard.isConfined
  def allowance: Allowance = guard.allowance

  /** Digests of what was read through this folder and those made of it by `at`. */
  private[candela] def reads: ReadFiles = guard.reads

  /** Another folder, whose files are guarded as those of this one. */
  def at(other: Path): SceneFolder = new SceneFolder(other, guard)

  /** The same, with files that other files contain: they are in memory, and found by these names.
    */
  def withParts(contents: Map[String, ByteBuffer]): SceneFolder =
    new SceneFolder(path, guard, parts ++ contents)

  /** A file within another one. */
  def part(name: String): Option[InputFile] =
    parts.get(name).map(InputFile.part(path.resolve(name), _))

  /** The scene file itself, which the user has named: a pipe, too, unless it is confined. */
  def scene(file: Path): InputFile =
    if !isConfined then guard.named(file)
    else
      guard.open(file, None).filter(_.isRegular).getOrElse:
        throw Refusal(
          Code.Sandboxed,
          None,
          s"`$file` is not a regular file",
          "--sandbox reads regular files only"
        )

  /** The regular file of a name, if there is one.
    *
    * @param at where the scene names it
    * @throws Refusal if the scene may not read it, whether it exists or not
    */
  def locate(
      name: String,
      at: Option[SourcePos],
      folders: Seq[Path] = Vector(path)
  ): Option[InputFile] = part(name).orElse(candidates(folders, name, at).find(_.isRegular))

  /** The file of this name in the first of several folders, regular or not. */
  def existing(folders: Seq[Path], name: String, at: Option[SourcePos]): Option[InputFile] =
    candidates(folders, name, at).nextOption()

  private def candidates(folders: Seq[Path], name: String, at: Option[SourcePos]) =
    folders.iterator.flatMap(SceneFolder.resolved(_, name)).flatMap(guard.open(_, at))

  /** As `locate`, but without counting; files that the scene may not read are absent. */
  def belonging(name: String): Option[Path] =
    SceneFolder.resolved(path, name).filter(guard.mayOpen).filter(Files.isRegularFile(_))

  /** Message and help if `locate` has no result.
    *
    * @param nothing message if no file has this name
    */
  def absence(
      name: String,
      at: Option[SourcePos],
      nothing: String,
      folders: Seq[Path] = Vector(path)
  ): (String, Option[String]) =
    existing(folders, name, at) match
      case Some(other) => (other.obstacle.fold(nothing)(w => s"`$name`: $w"), None)
      case None => (nothing, suggestion(name))

  /** As `belonging`, for a look without counting. */
  def glance(name: String): Option[InputFile] =
    part(name).orElse(belonging(name).flatMap(_ => locate(name, None)))

  /** A similar name in the folder, after `locate` has found nothing. Hidden files, such as locks,
    * resemble hidden ones only.
    */
  def suggestion(name: String): Option[String] =
    def isHidden(file: String) = file.startsWith(".")
    SceneFolder.resolved(path, name).flatMap: p =>
      val hidden = Option(p.getFileName).exists(f => isHidden(f.toString))
      Suggest.file(p, guard.namesBeside(p).filter(isHidden(_) == hidden))

  /** A file's path from here. */
  def relativize(file: Path): Path = path.relativize(file)

  override def equals(other: Any): Boolean = other match
    case that: SceneFolder => path == that.path
    case _ => false

  override def hashCode: Int = path.hashCode
  override def toString: String = path.toString

object SceneFolder:
  /** A folder whose scene may read every file. */
  def apply(path: Path): SceneFolder = new SceneFolder(path, FileGuard(path, false, Allowance()))

  /** The folder of a scene file.
    *
    * @param isConfined whether the scene may read no files but those in its folder or below it
    */
  def of(
      scene: Path,
      isConfined: Boolean = false,
      allowance: Allowance = Allowance()
  ): SceneFolder =
    val folder = Option(scene.getParent).getOrElse(Path.of(""))
    new SceneFolder(folder, FileGuard(folder, isConfined, allowance))

  /** A name like that of a missing file or folder, beside where it was looked for. */
  def suggestionFor(path: Path): Option[String] =
    Option(path.getFileName).flatMap(name => of(path).suggestion(name.toString))

  /** Of statements that name no files. */
  val Nowhere: SceneFolder = SceneFolder(Path.of(""))

  /** Whether a file may have this name: not if it has a zero byte, for example. */
  def isName(name: String): Boolean = resolved(Path.of(""), name).nonEmpty

  private def resolved(folder: Path, name: String): Option[Path] =
    try Option.when(name.nonEmpty)(folder.resolve(name.replace('\\', '/')))
    catch case _: InvalidPathException => None

/** Decides which files a scene may open, and counts them.
  *
  * @param root       the scene's folder
  * @param isConfined whether all files must be in it
  */
private final class FileGuard(root: Path, val isConfined: Boolean, val allowance: Allowance):
  val reads: ReadFiles = ReadFiles()
  private lazy val realRoot = Try(root.toAbsolutePath.toRealPath()).toOption

  def mayOpen(path: Path): Boolean = !isConfined || inside(path).nonEmpty

  /** The file, if it exists; a folder or a pipe, too. */
  def open(path: Path, at: Option[SourcePos]): Option[InputFile] =
    val location = if isConfined then inside(path).getOrElse(throw outside(path, at)) else path
    Option.when(Files.exists(location)):
      if isConfined && !Files.isRegularFile(location) && !Files.isDirectory(location) then
        throw Refusal(
          Code.Sandboxed,
          at,
          s"expected a regular file, found a pipe or a device: `$path`",
          "--sandbox reads regular files only"
        )
      allowance.countFile(location, at)
      def gate(count: Long) = allowance.countBytes(count, path, at)
      InputFile(path, location, gate, mayBePipe = false, shown = isInside(path), reads)

  /** A file that the user has named, of any kind. */
  def named(path: Path): InputFile =
    InputFile(
      path,
      path,
      allowance.countBytes(_, path, None),
      mayBePipe = true,
      shown = true,
      reads
    )

  private def outside(path: Path, at: Option[SourcePos]): Refusal =
    val isLink = path.toAbsolutePath.normalize.startsWith(root.toAbsolutePath.normalize)
    val description =
      if realRoot.isEmpty then s"`$path`; there is no folder `$root`"
      else if isLink then s"`$path`, a link that leads out of it or nowhere" else s"`$path`"
    Refusal(Code.Sandboxed, at, s"expected a file in the scene's folder, found $description", Help)

  private val Help = "--sandbox lets scenes read the files of their own folder only"

  /** Listed once, as thousands of files may be missing. */
  private val listed = ConcurrentHashMap[Path, Vector[String]]()

  /** Of files beside another, if they can be told. */
  def namesBeside(file: Path): Vector[String] =
    def list(folder: Path) = Try:
      Using.resource(Files.list(folder)): all =>
        all.iterator.asScala.take(FileGuard.MaxNames).map(_.getFileName.toString).toVector
    Option(file.toAbsolutePath.getParent)
      .fold(Vector.empty)(listed.computeIfAbsent(_, list(_).getOrElse(Vector.empty)))

  /** Remembered, as files may be opened as often as scenes include them. */
  private val insideCache = ConcurrentHashMap[Path, Boolean]()
  private def isInside(path: Path) = insideCache.computeIfAbsent(path, inside(_).nonEmpty)

  /** The real path of a file that may not exist yet; None if it is outside of the folder. */
  private def inside(path: Path): Option[Path] =
    val absolute = path.toAbsolutePath
    val nameCount = absolute.getNameCount
    val parents = Iterator.iterate(absolute)(_.getParent).takeWhile(_ != null)
    for
      root <- realRoot
      ancestor <- parents.find(Files.exists(_, LinkOption.NOFOLLOW_LINKS))
      real <- Try(ancestor.toRealPath()).toOption // not of links that lead nowhere
      tailCount = nameCount - ancestor.getNameCount
      target =
        if tailCount == 0 then real
        else real.resolve(absolute.subpath(nameCount - tailCount, nameCount)).normalize
      if target.startsWith(root)
    yield target

private object FileGuard:
  private val MaxNames = 10_000
