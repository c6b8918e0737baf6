package candela.image

import candela.base.{FileName, WholeFile}

import java.io.IOException
import java.nio.file.{Files, NoSuchFileException, Path}

/** Pictures in files, whatever the format. Everything that goes wrong is an [[ImageError]]. */
object ImageFiles:

  /** Suffixes of files that can be read, the most exact first. */
  val readable: Vector[String] = Vector("exr", "hdr", "pic", "png", "tga", "jpg", "jpeg")

  private val Readable = "EXR, HDR (Radiance), PNG, JPEG and TGA files can be read"
  private val Writable = s"images are written as ${OutputFormat.listed()}"

  /** The picture as Floats. Pictures of 8 and 16 bits hold [0, 1] and say that they are
    * sRGB-encoded; `linear` decodes them.
    */
  def read(path: Path): Image = load(path).toImage

  /** The picture as compact as its file has it: 8 bits stay 8 bits. */
  def load(path: Path): StoredImage =
    val bytes =
      try Files.readAllBytes(path)
      catch
        case _: NoSuchFileException => throw ImageError(s"$path: there is no such file")
        case e: IOException => throw ImageError(s"$path: can't be read: ${reason(e)}")
        case _: OutOfMemoryError => throw ImageError(s"$path: a file of 2 GB or more")
    try decode(bytes, FileName.suffix(path))
    catch
      case e: ImageError => throw ImageError(s"$path: ${e.getMessage}")
      case _: OutOfMemoryError => throw ImageError(s"$path: not enough memory for its pixels")

  /** What the file begins with outranks its name, which people change: the four marks can't begin a
    * valid TGA file, the one format that has none.
    */
  private def decode(bytes: Array[Byte], extension: String): StoredImage =
    def begins(mark: Int*) =
      bytes.length >= mark.size && mark.indices.forall(i => (bytes(i) & 0xff) == mark(i))
    if bytes.isEmpty then throw ImageError("the file is empty")
    else if begins(0x76, 0x2f, 0x31, 0x01) then Exr.read(bytes)
    else if begins('#', '?') then Hdr.read(bytes)
    else if begins(0x89, 'P', 'N', 'G') || begins(0xff, 0xd8) || extension == "tga" then
      StbReader.read(bytes)
    else if readable.contains(extension) then
      throw ImageError(s"not a valid .$extension file: it begins with other bytes")
    else throw ImageError(s"unknown format; $Readable")

  /** Writes in the format of the file's suffix.
    *
    * The picture appears under its name whole or not at all: it is written beside it and renamed.
    *
    * @param metadata names and texts that the file carries along
    * @param isHalf   floats of 16 bits, not 32, if the format has both
    */
  def write(
      path: Path,
      image: Image,
      metadata: Vector[(String, String)] = Vector.empty,
      isHalf: Boolean = false
  ): Unit =
    val bytes =
      try
        (OutputFormat.of(path), FileName.suffix(path)) match
          case (Some(format), _) => format.write(image, metadata, isHalf)
          case (None, "") => throw ImageError(s"the name has no extension; $Writable")
          case (None, other) => throw ImageError(s"can't write .$other files; $Writable")
      catch case e: ImageError => throw ImageError(s"$path: ${e.getMessage}")
    try WholeFile.write(path, bytes)
    catch
      case _: NoSuchFileException => throw ImageError(s"$path: there is no such folder")
      case e: IOException => throw ImageError(s"$path: can't be written: ${reason(e)}")

  /** What `write` puts into an `.exr` file. */
  def exr(image: Image): Array[Byte] = Exr.write(image, Vector.empty)

  private def reason(e: IOException): String =
    e.getClass.getSimpleName.stripSuffix("Exception") match
      case "AccessDenied" => "access denied"
      case _ => Option(e.getMessage).getOrElse(e.getClass.getSimpleName)
