package candela.build.recipe

import candela.base.{ByteCount, Version}
import candela.concurrency.Parallel
import candela.diagnostics.{Code, Refusal}
import candela.io.{CacheFolder, FileDigests, InputFile, Keep, PartFiles, PartForm, Sha256}
import java.io.IOException
import java.nio.file.Path
import java.util.Locale
import java.util.concurrent.ConcurrentHashMap

import candela.image.ImageSize
import candela.scenefile.{Declaration, Dialect, SceneDescription}
import candela.settings.TextureControl
import candela.textures.{TileCache, TileMemory}

/** Keeps the images of a scene: in memory, or in tiles if they may not fit.
  *
  * @param tiles        of textures; none: in memory
  * @param lightTiles   of environment maps; none: in memory
  * @param images       in words; empty if there are none
  * @param folder       of files of tiles
  * @param bytes        that the images take in memory, estimated
  * @param tables       files of what is made of images in tiles
  * @param knownDigests digests of files that have not changed since a rendering before
  */
final class TextureStore private (
    val tiles: Option[TileCache],
    val lightTiles: Option[TileCache],
    images: String,
    folder: Option[CacheFolder],
    val bytes: Long,
    files: Vector[InputFile],
    pool: Parallel,
    keep: Keep,
    tables: Option[PartFiles],
    knownDigests: FileDigests
):
  /** For people, if there are images.
    *
    * @param prepared images whose files have levels that are used as they are
    */
  def describe(prepared: Int): Option[String] =
    val whose =
      if prepared == 0 then "all in"
      else if prepared < files.size then s"$prepared of them in their own files, the others in"
      else "in their own files"
    val exceptions =
      if tiles.exists(_.trouble.nonEmpty) then ", but for those that can't be written" else ""
    val location = folder.map(_.path).map: f =>
      if prepared < files.size then s", $whose $f$exceptions" else s", $whose"
    Option.when(images.nonEmpty)(images + location.getOrElse(""))

  /** Of each file, and whether it is surely as it was then. */
  private val digests = ConcurrentHashMap[Path, (String, () => Boolean)]()

  private lazy val digested: Unit = pool.forEach(files.size): i =>
    try noted(files(i)): Unit
    catch case _: IOException | _: Refusal => () // told when the image is asked for
    knownDigests.save()

  private def noted(file: InputFile): (String, () => Boolean) =
    digests.computeIfAbsent(
      file.path,
      _ =>
        val isSame = file.watch()
        val fileDigest = knownDigests(file):
          if keep.isKeeping then keep.digest(file) else Sha256.ofAll(file.stream())
        (TextureStore.versioned(fileDigest), isSame)
    )

  /** Digest of a file's content.
    *
    * @throws IOException if it can't be read
    */
  def digest(file: InputFile): String =
    digested
    noted(file)._1

  /** Whether the file is as it was. */
  def isSame(file: InputFile): Boolean =
    try
      val (digest, isSurely) = noted(file)
      isSurely() || TextureStore.versioned(file.digest()) == digest
    catch case _: IOException => false

  /** A value derived from an image in tiles, stored in a file, too.
    *
    * @param key identifies all its inputs
    */
  def table[A](form: PartForm[A], key: String)(make: => A): A =
    def written(files: PartFiles) =
      val value = make
      files.write(form, key, value)
      value
    tables.fold(make)(files => files.read(form, key).getOrElse(written(files)))

  /** Says, once, that files of tiles or tables can't be written. */
  def warn(problems: Findings): Unit =
    for remark <- folder.flatMap(_.remark) do
      problems.warn(Code.OutputConflict, None, remark)
    def report(why: String, effect: String) =
      problems.warn(Code.Unwritable, None, s"$why; $effect")
    tiles.flatMap(_.trouble) match
      case Some(why) =>
        report(why, "images without a file in the texture cache are kept in memory")
      case None =>
        for why <- tables.flatMap(_.trouble()) do
          report(why, "tables of environment maps are made again for each rendering")

object TextureStore:
  val InMemory: TextureStore =
    new TextureStore(
      None, None, "", None, 0, Vector.empty, Parallel.Alone, Keep.Nothing, None, FileDigests(None)
    )

  /** In memory up to this share of the heap, and this size. */
  private val ShareOfHeap = 8
  private val MaxBytesInMemory = 1_000_000_000L

  private val Environments = Set("infinite", "exinfinite")

  /** Parameters that name images. */
  private[build] val ImageNames = Vector("filename", "mapname")

  /** Whether the rows of the image of a light begin with the lowest.
    *
    * @param dialect of the statement
    */
  private[build] def isFromBelow(light: Declaration, dialect: Dialect): Boolean =
    dialect == Dialect.V2 && ImageNames.flatMap(light.param(_)).exists:
      _.strings.headOption.exists(_.toLowerCase(Locale.ROOT).endsWith(".tga"))

  /** Whether a light's image may be in tiles: maps of environments, with rows from the top. */
  private[build] def mayBeTiled(light: Declaration, dialect: Dialect): Boolean =
    Environments(light.name) && !isFromBelow(light, dialect)

  /** Bytes of a pixel of an environment map: as it is read, and in the colours of the scene. */
  private val Pixel = 24L

  def of(
      scene: SceneDescription,
      control: TextureControl,
      pool: Parallel,
      keep: Keep = Keep.Nothing
  ): TextureStore =
    val textures = filesOf(scene.textures.map(_.texture).filter(_.name == "imagemap"))
    // Environment maps are looked up at random: in tiles where that is asked for
    val maps = if control.memory.isEmpty then Vector.empty else filesOf(environments(scene))
    val files = (textures ++ maps).distinctBy(_.path)
    if files.isEmpty then InMemory
    else
      val size =
        sizeOf(textures)(_.asTexture) + sizeOf(maps)(s => s.width.toLong * s.height * Pixel)
      val defaultLimit = Math.min(Runtime.getRuntime.maxMemory / ShareOfHeap, MaxBytesInMemory)
      val limit = control.memory.getOrElse(defaultLimit)
      val images = if files.size == 1 then "1 image" else s"${files.size} images"
      val about = s"about ${ByteCount.format(size)}"
      def inMemory(why: String) =
        val bytes = sizeOf(textures)(_.asTexture)
        val summary = s"$images in memory, $about$why"
        new TextureStore(
          None, None, summary, None, bytes, files, pool, keep, None, FileDigests(None)
        )
      if size <= limit then inMemory(s" of ${ByteCount.format(limit)}")
      else
        control.cache match
          case None => inMemory(": there is no folder for tiles")
          case Some(path) =>
            val folder = CacheFolder(path, control.folderSize)
            val cache = Some(new TileCache(new TileMemory(limit), folder, pool))
            val summary = s"$images, $about, in tiles: at most ${ByteCount.format(limit)} in memory"
            val lights = if maps.isEmpty then None else cache
            val tables = lights.map(_ => PartFiles(folder))
            // What is kept in files has a table of its own
            val digests = FileDigests(Option.unless(keep.isFiled)(PartFiles(folder)))
            new TextureStore(
              cache, lights, summary, Some(folder), limit, files, pool, keep, tables, digests
            )

  private def sizeOf(files: Vector[InputFile])(bytes: ImageSize => Long): Long =
    files.map(f => ImageSize.guess(f).fold(0L)(bytes)).sum

  private def environments(scene: SceneDescription): Vector[Declaration] =
    scene.lights.map(_.light).filter: l =>
      mayBeTiled(l, l.dialect.getOrElse(scene.dialect.base))

  /** The images that statements name. */
  private def filesOf(statements: Vector[Declaration]): Vector[InputFile] =
    val names =
      for
        d <- statements
        p <- ImageNames.flatMap(d.param(_))
        name <- p.strings.headOption if name.nonEmpty
      yield (d.folder, name) -> p.valuesAt
    names.distinctBy(_._1).flatMap:
      case ((folder, name), at) => Refusal.placed(at)(folder.glance(name))

  /** Texels may differ from those of another version. */
  private def versioned(digest: String) = s"$digest ${Version.build}"
