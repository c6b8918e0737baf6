package candela.build.recipe

import java.io.IOException
import java.nio.file.Path
import java.util.concurrent.ConcurrentHashMap

import candela.base.{CacheFolder, Code, InputFile, Keep, Parallel, Refusal, Sha256, Version}
import candela.image.ImageSize
import candela.scenefile.SceneDescription
import candela.textures.{TileCache, TileMemory}

/** How image textures are kept; the image is the same.
  *
  * @param memory    for image textures, in bytes, if not a share of the heap
  * @param folder    of the files of tiles, if not the user's
  * @param folderSize bytes that these may take
  * @param isShared  whether the user's folder may be used
  */
final case class TextureControl(
    memory: Option[Long] = None,
    folder: Option[Path] = None,
    folderSize: Long = CacheFolder.UsualSize,
    isShared: Boolean = true
):
  /** The folder of files, if there is one. */
  def cache: Option[Path] = folder.orElse(if isShared then CacheFolder.usual() else None)

/** Keeps the image textures of a scene: in memory, or in tiles if they may not fit.
  *
  * @param tiles    none: in memory
  * @param bytes    that the images take in memory, estimated
  * @param describe for people, if there are any
  */
final class TextureStore private (
    val tiles: Option[TileCache],
    val describe: Option[String],
    val bytes: Long,
    files: Vector[InputFile],
    pool: Parallel,
    keep: Keep
):
  private val digests = ConcurrentHashMap[Path, String]()

  private lazy val digested: Unit = pool.each(files.size): i =>
    try note(files(i)): Unit
    catch case _: IOException | _: Refusal => () // told when the image is asked for

  private def note(file: InputFile): String =
    digests.computeIfAbsent(
      file.path,
      _ =>
        TextureStore.versioned(if keep.isKeeping then keep.digest(file)
        else TextureStore.digest(file))
    )

  /** What tells the content of a file from others.
    *
    * @throws IOException if it can't be read
    */
  def digest(file: InputFile): String =
    digested
    note(file)

  /** Whether the file is as it was. */
  def isSame(file: InputFile): Boolean =
    try TextureStore.versioned(TextureStore.digest(file)) == digest(file)
    catch case _: IOException => false

  /** Says, once, that files of tiles can't be written. */
  def warn(problems: Findings): Unit =
    for why <- tiles.flatMap(_.trouble) do
      problems.warn(
        Code.Unwritable,
        None,
        s"$why; images without a file in the texture cache are kept in memory"
      )

object TextureStore:
  val InMemory: TextureStore =
    new TextureStore(None, None, 0, Vector.empty, Parallel.Alone, Keep.Nothing)

  /** In memory up to this share of the heap, and this size. */
  private val ShareOfHeap = 8
  private val MostInMemory = 1_000_000_000L

  def of(
      scene: SceneDescription,
      control: TextureControl,
      pool: Parallel,
      keep: Keep = Keep.Nothing
  ): TextureStore =
    val files = filesOf(scene)
    if files.isEmpty then InMemory
    else
      val size = files.map(f => ImageSize.guess(f).fold(0L)(_.asTexture)).sum
      val usual = Math.min(Runtime.getRuntime.maxMemory / ShareOfHeap, MostInMemory)
      val most = control.memory.getOrElse(usual)
      val folder = control.cache
      val images = if files.size == 1 then "1 image" else s"${files.size} images"
      if size <= most then
        val say = s"$images in memory, about ${megabytes(size)} of ${megabytes(most)}"
        new TextureStore(None, Some(say), size, files, pool, keep)
      else
        folder match
          case None =>
            val say = s"$images in memory, about ${megabytes(size)}: there is no folder for tiles"
            new TextureStore(None, Some(say), size, files, pool, keep)
          case Some(path) =>
            val memory = new TileMemory(most)
            val cache = new TileCache(memory, CacheFolder(path, control.folderSize), pool)
            val say = s"$images, about ${megabytes(size)}, in tiles: at most ${megabytes(most)} " +
              s"in memory, all in $path"
            new TextureStore(Some(cache), Some(say), most, files, pool, keep)

  private def megabytes(bytes: Long): String = s"${(bytes + 500_000) / 1_000_000} MB"

  private def filesOf(scene: SceneDescription): Vector[InputFile] =
    val names =
      for
        t <- scene.textures.map(_.texture) if t.name == "imagemap"
        p <- t.param("filename")
        name <- p.strings.headOption
      yield (t.folder, name) -> p.valuesAt
    names.distinctBy(_._1).flatMap:
      case ((folder, name), at) => Refusal.placed(at)(folder.glance(name))

  private def digest(file: InputFile): String = Sha256.ofAll(file.stream())

  /** Texels may differ from those of another version. */
  private def versioned(digest: String) = s"$digest ${Version.current}"
