package candela.build.recipe

import candela.concurrency.Parallel
import candela.diagnostics.{Allowance, Code, Limit, Refusal, SourcePos}
import candela.io.{InputFile, IoReason, Keep, SceneFolder}
import java.io.IOException
import java.nio.file.Path
import java.util.concurrent.ConcurrentHashMap

import scala.collection.mutable
import scala.jdk.CollectionConverters.*

import candela.accel.tracing.WarmUps
import candela.color.{ColorBasis, Encoding, Rgb}
import candela.bsdf.layered.Coats
import candela.bsdf.subsurface.ProfileTables
import candela.image.{ExrLevels, ImageBands, ImageError, ImageFiles, StoredImage}
import candela.math.Position
import candela.render.CostKind
import candela.scenefile.{Declaration, Param}
import candela.settings.RenderSettings
import candela.textures.{
  CachedImage, FileLevels, MadeTexels, MipLevel, OddTexel, TexelFacts, Texels, TileCache, Wrap
}

/** Resources that do not depend on the colour basis: files, and tables computed from them. Safe for
  * threads: bases are made in parallel.
  *
  * @param mayBeSpectral whether rendering may be spectral
  * @param settings      the user's, over those of the scene's `Option` statements
  * @param rules         for all statements; else those of each statement's dialect
  * @param origin        where the origin of what is built lies in the scene's world
  * @param allowance     how much the scene may use
  * @param textures      how image textures are kept
  * @param cache         of what other scenes have built
  * @param isReadable    whether all statements could be read
  * @param pool          executes divisible work
  */
final class SharedResources(
    basis: ColorBasis,
    val mayBeSpectral: Boolean,
    val settings: RenderSettings,
    val rules: Option[Rules],
    val origin: Position,
    val allowance: Allowance,
    val textures: TextureStore,
    val cache: Keep = Keep.Nothing,
    isReadable: Boolean = true,
    pool: Parallel = Parallel.Alone
):
  /** Those of what is checked and never rendered. */
  private[recipe] def unread: SharedResources =
    SharedResources(
      basis, mayBeSpectral, settings, rules, origin, allowance, textures, isReadable = false
    )

  /** The spectra read so far. */
  val census = ColorCensus(basis, pool)

  /** Tells how long parts take to build. */
  val clock = BuildClock()

  /** Tables of coated materials, shared by materials with equal parameters. */
  val coats = Coats()

  /** Of the SIMD kernels. */
  val warmUps = WarmUps()

  /** BSSRDF profile tables, shared by materials with equal parameters. */
  val profiles = ProfileTables()

  @volatile private var footprints = Vector.empty[String]

  /** Features that need ray differentials, for messages; initially empty. */
  def footprintUses: Vector[String] = footprints

  def footprintsInWords: String =
    if settings.unfiltered then "none: textures are not filtered"
    else if footprints.isEmpty then "none: no texture needs them"
    else footprints.mkString("for ", ", ", "")

  /** Requests ray differentials or partial derivatives for a feature. */
  def askForFootprints(what: String): Unit = synchronized:
    if !footprints.contains(what) then footprints :+= what

  @volatile private var relief = false

  /** Does any surface so far have bumps or the like, which lean along its tangents? */
  def hasRelief: Boolean = relief

  /** Requests tangents for a feature, and footprints. */
  def askForRelief(what: String): Unit =
    relief = true
    askForFootprints(what)

  // Each of a hundred colour bases asks again
  private val files = ConcurrentHashMap[(SceneFolder, String), InputFile]()
  private val loaded = ConcurrentHashMap[Path, Either[ImageError, StoredImage]]()
  private val remarks = ConcurrentHashMap[Path, Option[(Code, String)]]()
  private val opened = ConcurrentHashMap[Path, Option[Either[String, ExrLevels]]]()
  private val inFiles = ConcurrentHashMap[(Path, String), Option[CachedImage]]()

  private val odd = ConcurrentHashMap[(Path, String), Option[OddTexel]]()

  /** Warns of the image of a texture that a parameter names, if texels are no numbers.
    *
    * @param ways  what its texels depend on, beside the file
    * @param first that is no number
    */
  def checkTexels(p: Param, site: Site, ways: String)(first: => Option[OddTexel]): Unit =
    for
      file <- Option(files.get((site.declaration.folder, p.strings.headOption.getOrElse(""))))
      OddTexel(x, y, value) <- odd.computeIfAbsent((file.path, ways), _ => first)
    do
      val message =
        s"$file: texels are NaN or infinite: the first, at ($x, $y), is $value; samples " +
          "that see them are discarded"
      site.problems.warn(Code.ImageContents, p.valuesAt, message)

  /** How images of textures are kept, if there are any. */
  def imagesInWords: Option[String] =
    val prepared = inFiles.entrySet.asScala.filter(_.getValue.nonEmpty).map(_.getKey._1)
    textures.describe(prepared.size)

  private val contents = ConcurrentHashMap[Path, String]()
  private val images = mutable.Map.empty[Path, Either[ImageError, StoredImage]]
  private val memoized = java.util.IdentityHashMap[Declaration, mutable.Map[Once[?], Any]]()

  /** As [[Once]]. */
  private[recipe] def memoize[T](statement: Declaration, what: Once[T])(make: => T): T =
    synchronized:
      memoized
        .computeIfAbsent(statement, _ => mutable.Map.empty)
        .getOrElseUpdate(what, make)
        .asInstanceOf[T] // what this key was given

  private val madeFor = mutable.Map.empty[(Once[?], AnyRef), Any]

  /** As [[Once.of]]. */
  private[recipe] def memoizeFor[T](key: AnyRef, what: Once[T])(make: => T): T = synchronized:
    madeFor.getOrElseUpdate((what, key), make).asInstanceOf[T] // what this key was given

  /** Resolves the file that a parameter names, relative to the scene's folder. Reports a missing
    * file and returns None.
    *
    * @param standIn replacement if the user chose to keep going
    */
  def file(p: Param, from: Declaration, problems: Findings, standIn: String): Option[InputFile] =
    val name = p.strings.headOption.getOrElse("")
    Option(files.get((from.folder, name))).orElse:
      val resolved = from.folder.locate(name, Some(p.valuesAt))
      resolved match
        case Some(there) => files.put((from.folder, name), there): Unit
        case None =>
          val pos = p.valuesAt
          val (message, help) = from.folder.absence(name, Some(pos), s"no file `$name`")
          problems.missing(Code.NoSuchFile, pos, message, standIn, help)
      resolved

  private val faults = ConcurrentHashMap[Path, Option[ImageError]]()

  /** The file of an image. Of a scene that can't be rendered anyway, only what is wrong before the
    * pixels is told: these take seconds.
    */
  private def toRead(p: Param, from: Declaration, problems: Findings, standIn: String) =
    file(p, from, problems, standIn).filter: file =>
      if !isReadable then
        for e <- faults.computeIfAbsent(file.path, _ => ImageFiles.fault(file)) do
          report(Left(e), file, p, problems, standIn): Unit
      isReadable

  private def load(file: InputFile, at: SourcePos): Either[ImageError, StoredImage] = synchronized:
    images.getOrElseUpdate(
      file.path.toAbsolutePath.normalize,
      try
        // The name tells the format
        val fileName = file.path.getFileName.toString
        val (image, content) =
          cache.ofFile(SharedResources.Images, file, fileName)(decoded(file, at))
        for digest <- content do contents.put(file.path, s"$digest $fileName"): Unit
        Right(image)
      catch case e: ImageError => Left(e)
    )

  /** The key of a loaded image, if it is kept for other scenes. */
  def keyOf(p: Param, from: Declaration): Option[String] =
    val name = p.strings.headOption.getOrElse("")
    Option(files.get((from.folder, name))).flatMap(file => Option(contents.get(file.path)))

  private def decoded(file: InputFile, at: SourcePos): StoredImage =
    clock.during(CostKind.Textures):
      ImageFiles.colored(file.path, ImageFiles.load(file, admit(file, at)))

  private def admit(file: InputFile, at: SourcePos)(width: Int, height: Int): Unit =
    allowance.check(Limit.Pixels, width.toLong * height, Some(at)):
      s"`${file.path.getFileName}` has $width×$height pixels"

  /** Loads the image that a parameter names; images are cached. */
  def image(
      p: Param,
      from: Declaration,
      problems: Findings,
      standIn: String = StandIns.Magentas
  ): Option[StoredImage] =
    toRead(p, from, problems, standIn).flatMap: file =>
      val image = loaded.computeIfAbsent(file.path, _ => load(file, p.valuesAt))
      report(image, file, p, problems, standIn)

  /** The image that a parameter names, in tiles.
    *
    * @param ways    what its texels depend on, beside the file
    * @param convert makes its texels
    */
  def tiled(
      tiles: TileCache,
      p: Param,
      site: Site,
      standIn: String,
      ways: String,
      wrap: Wrap
  )(convert: ImageBands => MadeTexels): Option[CachedImage] =
    toRead(p, site.declaration, site.problems, standIn).flatMap: file =>
      var isAgain = false
      def confirm() =
        if !textures.isSame(file) then
          throw ImageError(Code.Unreadable, s"$file: it has changed, or is gone")
      def converted(bands: => ImageBands) =
        if isAgain then confirm()
        isAgain = true
        convert(bands).copy(confirm = () => confirm())
      def wholeImage() = converted(ImageBands.of(decoded(file, p.valuesAt)))
      lazy val inBands = ImageBands.ofFile(file)
      def first() = inBands match
        case Some(bands) =>
          admit(file, p.valuesAt)(bands.width, bands.height)
          converted(bands)
        case None => wholeImage()
      val image =
        try
          val digest = Refusal.placed(p.valuesAt)(textures.digest(file))
          def inTiles(make: () => MadeTexels) =
            clock.during(CostKind.Textures)(tiles.image(s"$digest $ways", wrap)(make))
          try Right(inTiles(() => first()))
          catch
            // What is wrong with a file, and what may be overlooked, its decoder knows
            case _: ImageError if inBands.nonEmpty => Right(inTiles(() => wholeImage()))
        catch
          case e: ImageError => Left(e)
          case e: IOException =>
            Left(ImageError(Code.Unreadable, s"$file: can't be read: ${IoReason(e)}"))
      textures.warn(site.problems)
      report(image, file, p, site.problems, standIn)

  /** The key of an image in tiles. */
  def keyInTiles(p: Param, from: Declaration, ways: String): Option[String] =
    val name = p.strings.headOption.getOrElse("")
    Option(files.get((from.folder, name))).map(file => s"${textures.digest(file)} $ways")

  /** The image that a parameter names with the levels that its file has, if these can be used.
    *
    * @param ways   what its texels depend on, beside the file
    * @param accept tells the channels of colours, or why the levels can't be used; None: the image
    *   can't be used either, which reading it as a whole tells
    * @param colors of a small level, which stand for all
    */
  def prepared(p: Param, site: Site, standIn: String, ways: String, wrap: Wrap)(
      accept: ExrLevels => Either[Option[String], Vector[Int]]
  )(colors: Texels => Vector[Rgb]): Option[CachedImage] =
    toRead(p, site.declaration, site.problems, standIn).flatMap: file =>
      opened.computeIfAbsent(file.path, _ => levelsOf(file, p.valuesAt)).flatMap: found =>
        // Each use has a warning of its own
        found.left.map(Some(_)).flatMap(levels => accept(levels).map(levels -> _)) match
          case Right((levels, channels)) =>
            admit(file, p.valuesAt)(levels.width, levels.height)
            def image = inLevels(file, FileLevels(levels, channels), ways, wrap, colors)
            inFiles.computeIfAbsent((file.path, ways), _ => image)
          case Left(known) =>
            for why <- known do
              val message = s"$file: the levels in the file are not used: $why"
              site.problems.warn(Code.ImageContents, p.valuesAt, message)
            None

  /** Its tiles may be read while the scene is rendered: a film is of the file as it is now. */
  private def levelsOf(file: InputFile, at: SourcePos): Option[Either[String, ExrLevels]] =
    val levels = ExrLevels.of(file)
    try
      if levels.exists(_.isRight) then Refusal.placed(at)(textures.digest(file)): Unit
      levels
    catch case _: IOException => None

  /** None if the file is damaged: reading it as a whole tells. */
  private def inLevels(
      file: InputFile,
      fileLevels: FileLevels,
      ways: String,
      wrap: Wrap,
      colors: Texels => Vector[Rgb]
  ): Option[CachedImage] =
    clock.during(CostKind.Textures):
      try
        val small = fileLevels.sizes.indexWhere((w, h, _) => w.toLong * h <= SharedResources.Small)
        val texels = fileLevels.texels(small)
        // A small level is the mean of the others: what is no number in these is none in it
        val (w, h, _) = fileLevels.sizes.head
        val odd = texels.odd.map: o =>
          o.copy(x = o.x * (w / texels.width), y = o.y * (h / texels.height))
        val facts = TexelFacts(colors(texels), odd)
        val levels = textures.tiles match
          case Some(tiles) => tiles.levels(fileLevels, wrap)
          case None =>
            val (all, _) = cache.ofFile(SharedResources.Levels, file, ways):
              fileLevels.sizes.indices.map(fileLevels.texels).toArray
            all.map(MipLevel(_, wrap))
        Some(CachedImage(levels, Encoding.Linear, facts))
      catch case _: ImageError => None

  /** Reports what is to be said of an image. */
  private def report[A](
      image: Either[ImageError, A],
      file: InputFile,
      p: Param,
      problems: Findings,
      standIn: String
  ): Option[A] = image match
    case Right(image) =>
      val remark = remarks.computeIfAbsent(file.path, _ => ImageFiles.remark(file))
      for (code, text) <- remark do problems.warn(code, p.valuesAt, text)
      Some(image)
    case Left(e) =>
      problems.missing(e.code, p.valuesAt, e.getMessage, standIn)
      None

private object SharedResources:
  val Images: Keep.Shelf[StoredImage] = Keep.Shelf[StoredImage]()
  val Levels: Keep.Shelf[Array[Texels]] = Keep.Shelf[Array[Texels]]()

  /** Texels of levels that stand for the others. */
  private val Small = 4096L
