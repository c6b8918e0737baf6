package candela.textures

import candela.concurrency.Parallel
import candela.diagnostics.{Problem, SceneError}
import candela.io.{CacheFolder, IoReason, WriteError}
import java.io.IOException
import java.util.concurrent.ConcurrentHashMap

import candela.color.Encoding
import candela.image.ImageError

/** An image of a cache.
  *
  * @param encoding of the file
  * @param facts    of its texels
  */
final class CachedImage(
    val levels: Array[MipLevel],
    val encoding: Encoding,
    val facts: TexelFacts
)

/** Images that are read in tiles from files of a folder, which are made once. An image whose file
  * can't be written is kept in memory as it is. Safe for threads.
  *
  * @param pool makes levels of images in memory
  */
final class TileCache(memory: TileMemory, folder: CacheFolder, pool: Parallel = Parallel.Alone):
  private val images = ConcurrentHashMap[String, CachedImage]()
  @volatile private var obstacle: Option[String] = None

  /** Why files can't be written, if one could not. */
  def trouble: Option[String] = obstacle

  /** The image of this key.
    *
    * @param key  tells its content, and what is made of it
    * @param load makes its texels
    * @throws ImageError if the image can't be read
    */
  def image(key: String, wrap: Wrap)(load: () => MadeTexels): CachedImage =
    val cached = images.get(key)
    if cached != null then cached
    else synchronized(images.computeIfAbsent(key, _ => stored(key, wrap, load)))

  /** Levels that an image file has itself. */
  def levels(file: FileLevels, wrap: Wrap): Array[MipLevel] =
    val layouts = TileLayout.ofLevels(file.sizes, file.channels)
    val image = TiledImage(memory, file.source, TileLayout.count(layouts))
    layouts.map(TiledLevel(image, _, wrap, file.channels, Array.emptyFloatArray)).toArray

  private def stored(key: String, wrap: Wrap, load: () => MadeTexels): CachedImage =
    openFile(key) match
      case Some(file) => tiled(file, wrap, load)
      case None =>
        val texels = load()
        written(key, texels, wrap) match
          case Some(file) => tiled(file, wrap, load)
          case None =>
            val (levels, facts) = texels.inMemory(wrap, pool)
            CachedImage(levels.map(MipLevel(_, wrap)), texels.encoding, facts)

  private def fileOf(key: String) = folder.file(key, CacheFolder.Tiles)

  /** The file of this key, if there is one and it is undamaged as far as its header tells. */
  private def openFile(key: String): Option[TileFile] =
    val opened = TileFile.open(folder.open(fileOf(key)), key)
    if opened.nonEmpty then folder.touch(fileOf(key))
    opened

  private def written(key: String, texels: MadeTexels, wrap: Wrap): Option[TileFile] =
    if obstacle.nonEmpty || !TileCache.fits(texels) then None
    else
      try
        folder.write(fileOf(key))(TileFile.write(_, key, texels, wrap))
        openFile(key)
      catch
        case e: WriteError =>
          obstacle = Some(e.getMessage)
          None
        case e: IOException =>
          obstacle = Some(s"can't write to `${folder.path}`: ${IoReason(e)}")
          None

  private def tiled(file: TileFile, wrap: Wrap, load: () => MadeTexels): CachedImage =
    val header = file.header
    val meaning = header.meaning.toArray
    val noMeaning = Array.emptyFloatArray
    val image = TiledImage(memory, MendedSource(file, wrap, load), header.count)
    val levels = header.layouts.map: layout =>
      TiledLevel(
        image,
        layout,
        wrap,
        header.channels,
        if layout.isBytes then meaning else noMeaning
      )
    CachedImage(levels.toArray, header.encoding, header.facts)

  /** A file; if a tile of it is damaged, one that is made again, or memory. */
  private final class MendedSource(file: TileFile, wrap: Wrap, load: () => MadeTexels)
      extends TileSource:
    @volatile private var current = file
    @volatile private var packer: TilePacker | Null = null
    private var isMade = false

    def fill(tile: Int, buffer: TileBuffer): Unit =
      val fallback = packer
      if fallback != null then fallback.pack(tile, buffer.ints)
      else if !current.read(tile, buffer) then mend(tile, buffer)

    private def mend(tile: Int, buffer: TileBuffer): Unit = synchronized:
      if packer == null && (!isMade || !current.read(tile, buffer)) then
        try
          val texels = load()
          val rewritten = if isMade then None else written(file.header.key, texels, wrap)
          isMade = true
          rewritten match
            case Some(again) => current = again
            case None => packer = TilePacker(file.header.layouts, texels.inMemory(wrap, pool)._1)
        catch
          case e: ImageError =>
            val message = "a file of the texture cache is damaged, and can't be made again"
            throw SceneError(Problem.general(e.code, s"$message: ${e.getMessage}"))
        fill(tile, buffer)
      else if packer != null then fill(tile, buffer)

private object TileCache:

  /** Whether texels have numbers: those of very narrow images have not. */
  private def fits(texels: MadeTexels): Boolean =
    TileLayout.ofLevels(texels.sizes, texels.bands.channels).forall: layout =>
      layout.count.toLong << (layout.across + layout.down) < Int.MaxValue
