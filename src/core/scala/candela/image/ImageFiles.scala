package candela.image

import candela.base.{ByteCount, JavaHeap}
import candela.diagnostics.Code
import candela.io.{FileName, ForeignFile, InputFile, IoReason, WholeFile, WriteError}
import java.io.{IOException, InputStream}
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.ByteBuffer
import java.nio.file.{Files, NoSuchFileException, Path}

import scala.util.Using
import scala.util.control.ControlThrowable

/** An image file that is not written yet. */
final class EncodedImage private[image] (path: Path, parts: Vector[ByteBuffer]):
  /** @throws ImageError if it can't be written; an existing file then stays */
  def save(): Unit =
    try WholeFile.write(path, parts)
    catch case e: WriteError => throw ImageError(Code.Unwritable, e.getMessage)

  def bytes: Array[Byte] =
    val file = ByteBuffer.allocate(Math.toIntExact(parts.map(_.remaining.toLong).sum))
    parts.foreach(part => file.put(part.duplicate))
    file.array

/** Reads and writes image files of all supported formats. Every failure is an [[ImageError]]. */
object ImageFiles:

  /** Extensions of readable files, most accurate first. */
  val readable: Vector[String] = Vector(
    "exr", "pfm", "hdr", "pic", "png", "qoi", "tga", "bmp", "ppm", "pgm", "pbm", "pnm", "psd",
    "gif", "jpg", "jpeg"
  )

  private val Readable =
    "EXR, PFM, HDR (Radiance), PNG, QOI, TGA, JPEG, BMP, PPM, PSD and GIF files can be read"
  private val Writable = s"images are written as ${OutputFormat.listed()}"

  /** The image as Floats. Images of 8 and 16 bits are in [0, 1] and marked as sRGB-encoded;
    * `linear` decodes them.
    */
  def read(path: Path): Image = load(InputFile.named(path)).toImage

  /** The image as compact as in its file: 8 bits stay 8 bits.
    *
    * @param admit receives width and height, before there are pixels where the format tells
    */
  def load(file: InputFile, admit: (Int, Int) => Unit = (_, _) => ()): StoredImage =
    val bytes =
      try file.bytes()
      catch
        case _: NoSuchFileException =>
          throw ImageError(Code.NoSuchFile, s"$file: there is no such file")
        case e: IOException =>
          throw ImageError(Code.Unreadable, s"$file: can't be read: ${IoReason(e)}")
        case _: OutOfMemoryError =>
          throw ImageError(Code.TooLarge, s"$file: a file of 2 GB or more")
    try
      val image = decode(bytes, file.path, admit)
      admit(image.width, image.height)
      image
    catch
      case e: ImageError => throw ImageError(e.code, s"$file: ${e.getMessage}")
      case _: OutOfMemoryError =>
        val limit = ByteCount.format(JavaHeap.limit)
        val message = s"$file: not enough memory for its pixels: Java's heap is limited to $limit"
        throw ImageError(Code.OutOfMemory, message)

  /** What is wrong with a file, as far as it is read to know the size of the image. */
  def fault(file: InputFile): Option[ImageError] =
    try
      load(file, (_, _) => throw SizeKnown): Unit
      None
    catch
      case SizeKnown => None
      case e: ImageError => Some(e)

  private object SizeKnown extends ControlThrowable

  /** The image of a file, which must have colours.
    *
    * @throws ImageError if it has none
    */
  def colored[I <: StoredImage](path: Path, image: I): I =
    try
      val _ = image.colorChannels
      image
    catch case e: ImageError => throw ImageError(e.code, s"$path: ${e.getMessage}")

  /** Coding, windows and metadata of an EXR file; nothing for other formats. */
  def facts(path: Path): Vector[(String, String)] =
    part(path).fold(Vector.empty)(p => p.coding ++ p.texts)

  /** What the numbers of an EXR file are: half, floats or integers. */
  def precision(path: Path): Option[String] = part(path).map(_.precision)

  /** The place of an EXR file's image in a larger one, and its metadata. */
  def about(path: Path): (Option[ImageWindow], Vector[(String, String)]) =
    part(path).fold((None, Vector.empty))(p => (p.window, p.texts))

  private def part(path: Path): Option[ExrPart] =
    // A pipe is read once
    val bytes = if Files.isRegularFile(path) then Files.readAllBytes(path) else Array.emptyByteArray
    Option.when(bytes.startsWith(ExrMark))(Exr.part(bytes))

  /** What is not read of an EXR file of several parts, or could be read otherwise. */
  def partsRemark(path: Path): Option[String] =
    // A pipe is read once
    Option.when(Files.isRegularFile(path))(exrRemark(Files.newInputStream(path))).flatten
      .map(remark => s"$path: $remark")

  /** @param file is closed */
  private def exrRemark(file: InputStream): Option[String] =
    val start = Using.resource(file)(_.readNBytes(HeadBytes))
    Option.when(start.startsWith(ExrMark))(Exr.remark(start)).flatten

  /** How pbrt-v4 reads the file differently, if it does; or what of it is missing. */
  def remark(file: InputFile): Option[(Code, String)] =
    val suffix = FileName.suffix(file.path)
    val note =
      if suffix == "exr" then exrRemark(file.again()).map(Code.ImageContents -> _)
      else if !Remarkable(suffix) then None
      else
        val size = file.size
        val (start, end) = Using.resource(file.again()): in =>
          val beginning = in.readNBytes(HeadBytes)
          in.skipNBytes(Math.max(0, size - beginning.length - (1 << 12)))
          (beginning, in.readAllBytes())
        // A small file has its end in the beginning
        val cut =
          if CutFile.isPacked(suffix, start) then CutFile.packed(file.bytes())
          else CutFile.remark(suffix, start, start.takeRight(1 << 12) ++ end, size)
        cut.orElse:
          if suffix == "qoi" then None
          else if suffix == "tga" then Tga.remark(start) else Pnm.remark(start)
        .map(Code.CutImage -> _)
    note.map((code, text) => code -> s"$file: $text")

  private val HeadBytes = 1 << 16

  private val Remarkable = Set("qoi", "tga", "ppm", "pgm", "pbm", "pnm", "jpg", "jpeg", "bmp")

  /** Whether the file is a whole image whose metadata contain the text, if its format has any. */
  def isWhole(path: Path, text: String): Boolean =
    Files.isRegularFile(path) && OutputFormat.of(path).exists: format =>
      try
        val bytes = Files.readAllBytes(path)
        val holds = !format.keepsTexts || String(bytes, ISO_8859_1).contains(text)
        holds && {
          if format.isReadable then decode(bytes, path, (_, _) => ()): Unit
          format.hasEnd(bytes)
        }
      catch case _: ImageError | _: IOException | _: OutOfMemoryError => false

  private val Scenes = Set("pbrt", "xml")

  private[image] val ExrMark = Array[Byte](0x76, 0x2f, 0x31, 0x01)

  /** The file's signature overrides its extension, which may be wrong: none of the signatures can
    * begin a valid TGA file, the only format without one.
    *
    * @param admit receives width and height before there are pixels, where few bytes may be many
    */
  private def decode(bytes: Array[Byte], path: Path, admit: (Int, Int) => Unit): StoredImage =
    val extension = FileName.suffix(path)
    def begins(mark: Int*) =
      bytes.length >= mark.size && mark.indices.forall(i => (bytes(i) & 0xff) == mark(i))
    def beginsWith(mark: String) = begins(mark.map(_.toInt)*)
    if bytes.isEmpty then throw ImageError(Code.DamagedImage, "the file is empty")
    else if bytes.startsWith(ExrMark) then Exr.read(bytes, admit = admit)
    else if beginsWith("#?") then Hdr.read(bytes)
    else if beginsWith("PF") || beginsWith("Pf") then Pfm.read(bytes)
    else if beginsWith("qoif") then Qoi.read(bytes, admit)
    else if Pnm.isMark(bytes) then Pnm.read(bytes)
    else if begins(0x89, 'P', 'N', 'G') || begins(0xff, 0xd8) || StbMarks.exists(beginsWith) then
      StbReader.read(bytes, admit)
    else if extension == "tga" then Tga.read(bytes, admit)
    else if OutputFormat.of(path).exists(!_.isReadable) then
      throw ImageError(Code.UnknownFormat, s".$extension files are written, not read; $Readable")
    else
      val foreign = ForeignFile.of(path, bytes)
      throw ImageError(
        Code.UnknownFormat,
        if readable.contains(extension) then
          val contents = foreign.fold("its first bytes are wrong")(o => s"it is ${o.what}")
          s"not a valid .$extension file: $contents"
        else
          val kind = foreign.map(_.what).orElse(Option.when(Scenes(extension))("a scene"))
          val explanation = kind.fold("unknown format")(w =>
            if w.endsWith("image") then s"$w can't be read" else s"it is $w, not an image"
          )
          s"$explanation; $Readable"
      )

  /** Writes in the format of the file's extension.
    *
    * Atomic: writes to a temporary file beside the target and renames it.
    *
    * @param metadata names and texts to store in the file
    */
  def write(
      path: Path,
      image: Image,
      metadata: Vector[(String, String)] = Vector.empty,
      options: WriteOptions = WriteOptions()
  ): Unit =
    encoded(path, image, metadata, options).save()

  /** What [[write]] stores in a file of this name. */
  def encoded(
      path: Path,
      image: Image,
      metadata: Vector[(String, String)] = Vector.empty,
      options: WriteOptions = WriteOptions()
  ): EncodedImage =
    try
      (OutputFormat.of(path), FileName.suffix(path)) match
        case (Some(format), _) => EncodedImage(path, format.buffers(image, metadata, options))
        case (None, "") =>
          throw ImageError(Code.UnknownFormat, s"the name has no extension; $Writable")
        case (None, other) =>
          throw ImageError(Code.UnknownFormat, s"can't write .$other files; $Writable")
    catch case e: ImageError => throw ImageError(e.code, s"$path: ${e.getMessage}")

  /** The bytes that `write` stores in an `.exr` file. */
  def exr(image: Image): Array[Byte] = Exr.write(image, Vector.empty)

  /** The bytes that `write` stores in a `.png` file. */
  def png(image: Image): Array[Byte] = Png.write(image, Vector.empty)

  /** Signatures of BMP, GIF and PSD. */
  private val StbMarks = Vector("BM", "GIF8", "8BPS")
