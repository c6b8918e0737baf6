package candela.image

import candela.diagnostics.Code
import candela.color.{ColorSpace, Primaries}

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.{ByteBuffer, ByteOrder}
import scala.collection.mutable

/** A channel of an EXR part; `pixelType` is 0 for unsigned integer, 1 for half, 2 for float. */
private[image] final case class ExrChannel(
    name: String,
    pixelType: Int,
    xSampling: Int,
    ySampling: Int
)

/** Header of an EXR part, as far as needed to read it.
  *
  * @param name   of the part, in a file of several
  * @param width  of the data window, as `height`
  * @param tiling present if the part is tiled
  * @param x, y   first pixel of the data window
  * @param window where the data window lies in another display window
  * @param coding compression, tiles and windows, for people
  * @param texts  metadata
  * @param obstacle what the decoder can't read
  */
private[image] final case class ExrPart(
    name: String,
    channels: Vector[ExrChannel],
    compression: Int,
    width: Int,
    height: Int,
    tiling: Option[ExrTiling],
    x: Int,
    y: Int,
    colorSpace: ColorSpace,
    window: Option[ImageWindow],
    coding: Vector[(String, String)],
    texts: Vector[(String, String)],
    obstacle: Option[String]
):
  /** What the numbers of its channels are, for people. */
  def precision: String =
    channels.map(c => ExrHeader.Precisions(c.pixelType)).distinct.mkString(" and ")

  /** The channels' names without that of the part, with which writers may begin them. */
  def ownNames: Vector[String] = channels.map(_.name.stripPrefix(s"$name."))

  /** Whether it has the pixels of another part. */
  def covers(part: ExrPart): Boolean =
    (x, y, width, height) == (part.x, part.y, part.width, part.height)

  /** Uncompressed size of the finest level. */
  def storedBytes: Long = bytes(width, height)

  /** Uncompressed size of some pixels. */
  def bytes(w: Int, h: Int): Long =
    w.toLong * h * channels.map(c => if c.pixelType == ExrHeader.HalfFloat then 2L else 4L).sum

  /** Upper bound of its compression ratio; DWA and HTJ2K drop details of blocks before. */
  def maxRatio: Int = if obstacle.isEmpty then ExrHeader.MaxRatio else 64 * ExrHeader.MaxRatio

/** Tiling of a part: tiles of `width` × `height`; `levelMode` is 0 for one level, 1 for a MIP map,
  * 2 for a RIP map (levels halved in each direction separately).
  */
private[image] final case class ExrTiling(
    width: Int,
    height: Int,
    levelMode: Int,
    roundsUp: Boolean
):
  /** Whether there are smaller levels. */
  def hasLevels: Boolean = levelMode != 0

  private def levels(size: Int): Int =
    val floor = 31 - Integer.numberOfLeadingZeros(size)
    1 + floor + (if roundsUp && (size & (size - 1)) != 0 then 1 else 0)

  /** An edge of a level. */
  private def edge(size: Int, level: Int): Int =
    val carry = if roundsUp then (1L << level) - 1 else 0L
    Math.max(1L, (size + carry) >> level).toInt

  /** Width and height of the levels of the MIP map of a part of `w` × `h` pixels. */
  def sizes(w: Int, h: Int): Vector[(Int, Int)] =
    Vector.tabulate(levels(Math.max(w, h)))(l => (edge(w, l), edge(h, l)))

  /** Number of tiles in a level of `w` × `h` pixels. */
  def inLevel(w: Int, h: Int): Long = count(w, 0, width) * count(h, 0, height)

  private def count(size: Int, level: Int, tile: Int): Long =
    (edge(size, level) + tile - 1L) / tile

  /** Number of tiles in all levels of a part of `w` × `h` pixels. */
  def tiles(w: Int, h: Int): Long = levelMode match
    case 0 => inLevel(w, h)
    case 1 => sizes(w, h).map(inLevel(_, _)).sum
    case _ =>
      val across = (0 until levels(w)).map(count(w, _, width)).sum
      across * (0 until levels(h)).map(count(h, _, height)).sum

/** Reads and validates EXR headers: only files that decode correctly reach the native decoder.
  *
  * Source: "OpenEXR File Layout", openexr.com.
  */
private[image] object ExrHeader:

  private val Compressions = Vector(
    "none", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB", "HTJ2K256",
    "HTJ2K32"
  )

  /** Scanlines per chunk, by compression. */
  private val ChunkRows = Vector(1, 1, 1, 16, 32, 16, 32, 32, 32, 256, 256, 32)

  /** Pixel type of channels of 16-bit floats. */
  val HalfFloat = 1

  val Precisions: Vector[String] = Vector("integers", "half", "floats")

  /** Upper bound of the format's compression ratios: deflate reaches 1032, over the 3 of 4 bytes
    * that PXR24 keeps. Limits the memory that a damaged size can request.
    */
  private[image] val MaxRatio = 1400

  /** The last compression that the decoder knows. */
  private val LastRead = 7
  private val MaxAttributes = 128
  private val MaxChannels = 256
  private val MaxTile = 1 << 16

  /** The parts of a file, validated; at least one. */
  def parts(file: Array[Byte]): Vector[ExrPart] =
    val (headers, table) = parts(Reader(file), isWhole = true)
    val remainingBytes = file.length.toLong - table
    // A chunk has 8 bytes in the table and 8 or more of its own.
    if headers.map(chunks).sum * 16 > remainingBytes then
      throw ImageError(Code.DamagedImage, "the file is cut short")
    for p <- headers if p.storedBytes > file.length.toLong * p.maxRatio do
      throw ImageError(
        Code.DamagedImage,
        s"${p.width}×${p.height} pixels can't be in a file of ${file.length} bytes"
      )
    headers

  /** The parts by the beginning of a file, which is read in tiles and may be larger than memory.
    *
    * @return also where the headers end
    */
  def ofBeginning(file: Array[Byte]): (Vector[ExrPart], Int) = parts(Reader(file), isWhole = false)

  private def parts(in: Reader, isWhole: Boolean): (Vector[ExrPart], Int) =
    val _ = in.int()
    val word = in.int()
    val version = word & 0xff
    if version != 2 then
      throw ImageError(Code.UnsupportedImage, s"EXR version $version is not supported")
    val isMultipart = (word & 0x1000) != 0
    val flags = Option.when(!isMultipart)(word)
    val headers = mutable.ArrayBuffer(part(in.attributes(), flags, isWhole))
    if isMultipart then
      var attributes = in.attributes()
      while attributes.nonEmpty do
        headers += part(attributes, flags, isWhole)
        attributes = in.attributes()
    (headers.toVector, in.position)

  private[image] def chunks(part: ExrPart): Long = part.tiling match
    case Some(tiling) => tiling.tiles(part.width, part.height)
    case None =>
      val rows = ChunkRows(part.compression)
      (part.height.toLong + rows - 1) / rows

  /** @param flags version flags, which define the type of a single part; multi-part files define it
    *   per part
    */
  private def part(
      attributes: Map[String, (String, ByteBuffer)],
      flags: Option[Int],
      isWhole: Boolean
  ): ExrPart =
    def value(name: String, kind: String, size: Int): Option[ByteBuffer] =
      attributes.get(name).map: (actualKind, data) =>
        if actualKind != kind || data.remaining < size then
          throw ImageError(Code.DamagedImage, s"attribute `$name` is damaged")
        data
    def required(name: String, kind: String, size: Int): ByteBuffer =
      value(
        name,
        kind,
        size
      ).getOrElse(throw ImageError(Code.DamagedImage, s"attribute `$name` is missing"))

    val kind = value("type", "string", 0).map(UTF_8.decode(_).toString)
    val isDeep = flags.exists(f => (f & 0x800) != 0) || kind.exists(_.startsWith("deep"))
    if isDeep then throw ImageError(Code.UnsupportedImage, "deep EXR files are not supported")
    val isTiled = flags.fold(kind.contains("tiledimage"))(f => (f & 0x200) != 0)
    if kind.exists(_ != (if isTiled then "tiledimage" else "scanlineimage")) then
      throw ImageError(Code.UnsupportedImage, s"parts of type `${kind.mkString}` are not supported")
    val tiling = Option.when(isTiled)(tilesOf(required("tiles", "tiledesc", 9)))
    val window = required("dataWindow", "box2i", 16)
    val Vector(x0, y0, x1, y1) = Vector.fill(4)(window.getInt().toLong): @unchecked
    val channels = channelList(required("channels", "chlist", 1))
    val compression = required("compression", "compression", 1).get() & 0xff
    val (width, height) = (x1 - x0 + 1, y1 - y0 + 1)
    if width < 1 || height < 1 then throw ImageError(Code.DamagedImage, "the data window is empty")
    checkSize(width, height, if isWhole then channels.size else 0, tiling)
    val unread = obstacle(compression, channels)
    val space = value("chromaticities", "chromaticities", 32).fold(ColorSpace.Srgb)(spaceOf)
    val display = value("displayWindow", "box2i", 16).map(d => Vector.fill(4)(d.getInt()))
      .filter(_ != Vector(x0, y0, x1, y1))
    val placement = display.map: d =>
      val (left, top) = (d(0), d(1))
      ImageWindow(x0.toInt - left, y0.toInt - top, d(2) - left + 1, d(3) - top + 1)
    val coding = Vector("compression" -> Compressions(compression)) ++
      tiling.map(t => "tiles" -> s"${t.width}x${t.height}") ++
      display.map: d =>
        val full = s"${d(2) - d(0) + 1}x${d(3) - d(1) + 1}"
        "window" -> s"x $x0 to ${x1 + 1}, y $y0 to ${y1 + 1} of $full"
    val texts = attributes.toVector.collect:
      case (name, ("string", text)) if name != "type" && name != "name" =>
        name -> UTF_8.decode(text.duplicate).toString
    val name = value("name", "string", 0).fold("")(n => UTF_8.decode(n.duplicate).toString)
    val part = ExrPart(
      name, channels, compression, width.toInt, height.toInt, tiling, x0.toInt, y0.toInt, space,
      placement, coding, texts.sortBy(_._1), unread
    )
    // The decoder trusts this number, and a wrong one crashes the process.
    for count <- value("chunkCount", "int", 4) if count.getInt() != chunks(part) do
      throw ImageError(Code.DamagedImage, "attribute `chunkCount` is damaged")
    part

  private def tilesOf(data: ByteBuffer): ExrTiling =
    val (width, height, mode) = (data.getInt(), data.getInt(), data.get() & 0xff)
    if (mode & 15) > 2 || mode >> 4 > 1 then
      throw ImageError(Code.DamagedImage, "attribute `tiles` is damaged")
    ExrTiling(width, height, mode & 15, mode >> 4 == 1)

  private def spaceOf(data: ByteBuffer): ColorSpace =
    val primaries = Primaries.ofFloats(Array.fill(8)(data.getFloat()))
    ColorSpace.of(primaries)
      .getOrElse(throw ImageError(Code.DamagedImage, "attribute `chromaticities` is damaged"))

  private def checkSize(w: Long, h: Long, channels: Int, tiling: Option[ExrTiling]): Unit =
    // Without channels: of a file that is never in memory as a whole
    val maxPixels = if channels == 0 then Long.MaxValue else (Int.MaxValue - 8L) / channels
    val fits = w <= Int.MaxValue && h <= Int.MaxValue && w * h <= maxPixels
    if !fits then
      throw ImageError(
        Code.TooLarge,
        s"$w×$h pixels of $channels channels are more than fit into memory"
      )
    for t <- tiling do
      // Tiles may extend past the image; the decoder allocates each in full.
      def padded(size: Long, tile: Long) = (size + tile - 1) / tile * tile
      val sane = t.width > 0 && t.height > 0 && t.width <= MaxTile && t.height <= MaxTile &&
        padded(w, t.width) * padded(h, t.height) <= maxPixels
      if !sane then
        throw ImageError(
          Code.UnsupportedImage,
          s"tiles of ${t.width}×${t.height} pixels are not supported"
        )

  /** Why the decoder can't read this coding, if so. */
  private def obstacle(compression: Int, channels: Vector[ExrChannel]): Option[String] =
    val name = Compressions.lift(compression)
      .getOrElse(throw ImageError(
        Code.UnsupportedImage,
        s"EXR compression number $compression is not supported"
      ))
    val isB44 = name == "B44" || name == "B44A"
    if compression > LastRead then Some(s"EXR compression $name is not supported")
    else if isB44 && channels.exists(_.pixelType != HalfFloat) then
      Some(s"EXR compression $name is read for half channels only")
    else
      channels.find(c => c.xSampling != 1 || c.ySampling != 1).map(c =>
        s"channel `${c.name}` is subsampled, which is not supported"
      )

  private def channelList(data: ByteBuffer): Vector[ExrChannel] =
    val reader = Reader(data)
    val channels = mutable.ArrayBuffer.empty[ExrChannel]
    var name = reader.name()
    while name.nonEmpty do
      val pixelType = reader.int()
      if pixelType < 0 || pixelType > 2 then
        throw ImageError(Code.DamagedImage, s"channel `$name` has an unknown type")
      val _ = reader.int() // the perceptual-linearity hint and padding
      channels += ExrChannel(name, pixelType, reader.int(), reader.int())
      if channels.size > MaxChannels then
        throw ImageError(Code.DamagedImage, s"more than $MaxChannels channels")
      name = reader.name()
    if channels.isEmpty then throw ImageError(Code.DamagedImage, "it has no channels")
    val names = channels.map(_.name)
    if names.distinct.size != names.size then
      throw ImageError(Code.DamagedImage, "two channels have the same name")
    channels.toVector

  /** Little-endian reader with bounds checks. */
  private final class Reader(bytes: ByteBuffer):
    def this(file: Array[Byte]) = this(ByteBuffer.wrap(file).order(ByteOrder.LITTLE_ENDIAN))

    def position: Int = bytes.position

    private def requireBytes(count: Int): Unit =
      if count < 0 || count > bytes.remaining then
        throw ImageError(Code.DamagedImage, "the header is damaged")

    def int(): Int =
      requireBytes(4)
      bytes.getInt()

    /** Reads a zero-terminated string; empty at the end of a list. */
    def name(): String =
      val start = bytes.position
      requireBytes(1)
      while bytes.get() != 0 do requireBytes(1)
      val length = bytes.position - 1 - start
      if length > 255 then throw ImageError(Code.DamagedImage, "the header is damaged")
      val text = new Array[Byte](length)
      bytes.get(start, text)
      String(text, UTF_8)

    /** One header: name → (type, value). */
    def attributes(): Map[String, (String, ByteBuffer)] =
      val values = mutable.Map.empty[String, (String, ByteBuffer)]
      var key = name()
      while key.nonEmpty do
        val kind = name()
        val size = int()
        requireBytes(size)
        val value = bytes.slice(bytes.position, size).order(ByteOrder.LITTLE_ENDIAN)
        bytes.position(bytes.position + size)
        if values.contains(key) then
          throw ImageError(Code.DamagedImage, s"duplicate attribute `$key`")
        values(key) = (kind, value)
        if values.size > MaxAttributes then
          throw ImageError(Code.DamagedImage, s"more than $MaxAttributes attributes")
        key = name()
      values.toMap
