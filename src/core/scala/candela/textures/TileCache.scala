package candela.textures

import java.io.IOException
import java.util.concurrent.ConcurrentHashMap

import candela.base.{CacheFolder, IoReason, Problem, SceneError, WriteError}
import candela.color.{Encoding, Rgb}
import candela.image.ImageError

/** The texels of an image file.
  *
  * @param encoding of the file
  * @param colors   some that stand for all
  */
final case class MadeTexels(levels: Array[Texels], encoding: Encoding, colors: Vector[Rgb])

/** An image of a cache.
  *
  * @param encoding of the file
  * @param colors   some that stand for all
  */
final class CachedImage(
    val levels: Array[MipLevel],
    val encoding: Encoding,
    val colors: Vector[Rgb]
)

/** Images that are read in tiles from files of a folder, which are made once. An image whose file
  * can't be written is kept in memory as it is. Safe for threads.
  */
final class TileCache(memory: TileMemory, folder: CacheFolder):
  private val images = ConcurrentHashMap[String, CachedImage]()
  @volatile private var obstacle: Option[String] = None

  /** Why files can't be written, if one could not. */
  def trouble: Option[String] = obstacle

  /** The image of this key.
    *
    * @param key  tells its content, and what is made of it
    * @param make makes its texels
    */
  def image(key: String, wrap: Wrap)(make: () => MadeTexels): CachedImage =
    val known = images.get(key)
    if known != null then known
    else synchronized(images.computeIfAbsent(key, _ => stored(key, wrap, make)))

  private def stored(key: String, wrap: Wrap, make: () => MadeTexels): CachedImage =
    open(key) match
      case Some(file) => tiled(file, wrap, make)
      case None =>
        val made = make()
        written(key, made) match
          case Some(file) => tiled(file, wrap, make)
          case None => CachedImage(made.levels.map(MipLevel(_, wrap)), made.encoding, made.colors)

  private def place(key: String) = folder.file(key, CacheFolder.Tiles)

  /** The file of this key, if there is one and it is undamaged as far as its header tells. */
  private def open(key: String): Option[TileFile] =
    val opened = TileFile.open(place(key), key)
    if opened.nonEmpty then folder.use(place(key))
    opened

  private def written(key: String, made: MadeTexels): Option[TileFile] =
    if obstacle.nonEmpty || !TileCache.fits(made.levels) then None
    else
      try
        folder.write(place(key))(TileFile.write(_, TileCache.header(key, made), made.levels))
        open(key)
      catch
        case e: WriteError =>
          obstacle = Some(e.getMessage)
          None
        case e: IOException =>
          obstacle = Some(s"can't write to `${folder.path}`: ${IoReason(e)}")
          None

  private def tiled(file: TileFile, wrap: Wrap, make: () => MadeTexels): CachedImage =
    val header = file.header
    val meaning = header.meaning.toArray
    val none = Array.emptyFloatArray
    val image = TiledImage(memory, MendedSource(file, make), header.count)
    val levels = header.places.map: place =>
      TiledLevel(image, place, wrap, header.channels, if place.isBytes then meaning else none)
    CachedImage(levels.toArray, header.encoding, header.colors)

  /** A file; if a tile of it is damaged, one that is made again, or memory. */
  private final class MendedSource(file: TileFile, make: () => MadeTexels) extends TileSource:
    @volatile private var current = file
    @volatile private var packer: TilePacker | Null = null
    private var isMade = false

    def fill(tile: Int, buffer: TileBuffer): Unit =
      val known = packer
      if known != null then known.pack(tile, buffer.ints)
      else if !current.read(tile, buffer) then mend(tile, buffer)

    private def mend(tile: Int, buffer: TileBuffer): Unit = synchronized:
      if packer == null && (!isMade || !current.read(tile, buffer)) then
        val made =
          try make()
          catch
            case e: ImageError =>
              val what = "a file of the texture cache is damaged, and can't be made again"
              throw SceneError(Problem.general(e.code, s"$what: ${e.getMessage}"))
        val next = if isMade then None else written(file.header.key, made)
        isMade = true
        next match
          case Some(again) => current = again
          case None => packer = TilePacker(file.header.places, made.levels)
        fill(tile, buffer)
      else if packer != null then fill(tile, buffer)

private object TileCache:
  private def header(key: String, made: MadeTexels): TileHeader =
    val sizes = made.levels.map(t => (t.width, t.height, t.meaning.nonEmpty)).toVector
    TileHeader(
      key,
      made.encoding,
      made.colors,
      made.levels.head.channels,
      sizes,
      made.levels.head.meaning.toVector
    )

  /** Whether texels have numbers: those of very narrow images have not. */
  private def fits(levels: Array[Texels]): Boolean =
    val sizes = levels.map(t => (t.width, t.height, t.meaning.nonEmpty)).toVector
    TilePlace.all(sizes, levels.head.channels).forall: place =>
      place.count.toLong << (place.across + place.down) < Int.MaxValue
