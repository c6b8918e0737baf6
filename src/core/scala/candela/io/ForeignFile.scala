package candela.io

import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}
import java.util.Locale

import scala.util.Using

/** Kinds of files that are not scenes, by their use. */
enum ForeignKind:
  case Picture, Film, Suite, Triangles, MitsubaMesh, Model, Volume, Photometry, Packed, Mitsuba
  case Other

/** A file of another kind than the one that was expected.
  *
  * @param what with its article: `an OpenEXR image`
  */
final case class ForeignFile(kind: ForeignKind, what: String)

/** Recognises files by how they begin, and by their names where that does not tell. */
object ForeignFile:
  import ForeignKind.*

  /** Bytes that suffice. */
  val Head = 512

  /** Of a file that is not packed. */
  def of(path: Path): Option[ForeignFile] =
    Option.when(Files.isRegularFile(path)):
      Using.resource(Files.newInputStream(path))(in => of(path, in.readNBytes(Head)))
    .flatten

  /** @param start the first bytes, unpacked */
  def of(path: Path, start: Array[Byte]): Option[ForeignFile] =
    // Each byte is a character
    val text = String(start, 0, Math.min(start.length, Head), ISO_8859_1)
    val suffix = FileName.suffix(path)
    Marks.find(m => text.startsWith(m.text, m.at)).map(m => ForeignFile(m.kind, m.what))
      .orElse(byForm(text))
      .orElse(bySuffix(suffix, text))
      .orElse(if suffix == "xml" then None else markup(text.stripPrefix(Utf8Mark).stripLeading))
      .orElse(Option.when(isBinary(text))(ForeignFile(Other, "a binary file")))

  private final case class Mark(text: String, kind: ForeignKind, what: String, at: Int = 0)

  private val Marks: Vector[Mark] = Vector(
    Mark("\u0076\u002f\u0031\u0001", Picture, "an OpenEXR image"),
    Mark("\u0089PNG", Picture, "a PNG image"),
    Mark("\u00ff\u00d8\u00ff", Picture, "a JPEG image"),
    Mark("#?RADIANCE", Picture, "a Radiance HDR image"),
    Mark("#?RGBE", Picture, "a Radiance HDR image"),
    Mark("PF\n", Picture, "a PFM image"),
    Mark("Pf\n", Picture, "a PFM image"),
    Mark("qoif", Picture, "a QOI image"),
    Mark("GIF8", Picture, "a GIF image"),
    Mark("8BPS", Picture, "a Photoshop image"),
    Mark("II*\u0000", Other, "a TIFF image"),
    Mark("MM\u0000*", Other, "a TIFF image"),
    Mark("WEBP", Other, "a WebP image", at = 8),
    Mark("DDS ", Other, "a DDS image"),
    Mark("\u00abKTX", Other, "a KTX image"),
    Mark("ftypavif", Other, "an AVIF image", at = 4),
    Mark("ftyphei", Other, "an HEIF image", at = 4),
    Mark("Candela film", Film, "a saved rendering", at = 4),
    Mark("ply\n", Triangles, "a PLY mesh"),
    Mark("ply\r", Triangles, "a PLY mesh"),
    Mark("\u001c\u0004", MitsubaMesh, "a Mitsuba mesh file"),
    Mark("glTF", Model, "a glTF model"),
    Mark("BLENDER", Model, "a Blender file"),
    Mark("PXR-USDC", Model, "a USD file"),
    Mark("#usda", Model, "a USD file"),
    Mark("Kaydara FBX", Model, "an FBX file"),
    Mark("; FBX", Model, "an FBX file"),
    Mark("Ogawa", Model, "an Alembic file"),
    Mark("#VRML", Model, "a VRML file"),
    Mark("NanoVDB", Volume, "a NanoVDB volume"),
    Mark(" BDV", Other, "an OpenVDB volume"),
    Mark("VOL\u0003", Volume, "a Mitsuba volume"),
    Mark("IESNA", Photometry, "an IES photometric file"),
    Mark("SCATFUN", Other, "a BSDF table"),
    Mark("tensor_file\u0000", Other, "a measured BSDF"),
    Mark("PK\u0003\u0004", Packed, "a ZIP archive"),
    Mark("PK\u0005\u0006", Packed, "a ZIP archive"),
    Mark("7z\u00bc\u00af", Packed, "a 7z archive"),
    Mark("Rar!", Packed, "a RAR archive"),
    Mark("ustar", Packed, "a TAR archive", at = 257),
    Mark("\u00fd7zXZ", Packed, "an xz-compressed file"),
    Mark("BZh", Packed, "a bzip2-compressed file"),
    Mark("\u0028\u00b5\u002f\u00fd", Packed, "a zstd-compressed file, as Blender writes"),
    Mark("%PDF-", Other, "a PDF file"),
    Mark("\u007fELF", Other, "a program"),
    Mark("MZ\u0090\u0000", Other, "a program"),
    Mark("\u00ca\u00fe\u00ba\u00be", Other, "a Java class")
  )

  private val Utf8Mark = "\u00ef\u00bb\u00bf"

  private def byForm(text: String): Option[ForeignFile] =
    def zeros(from: Int, count: Int) = text.slice(from, from + count) == "\u0000" * count
    val isMap = text.length > 3 && text(0) == 'P' && text(1) >= '1' && text(1) <= '6' &&
      text(2).isWhitespace
    if text.startsWith("BM") && zeros(6, 4) then Some(ForeignFile(Picture, "a BMP image"))
    else if isMap then Some(ForeignFile(Picture, "a portable map"))
    else if text.startsWith("solid") && text.contains("facet ") then
      Some(ForeignFile(Model, "an STL mesh"))
    else None

  /** By suffix, if the text has what such files have. */
  private def bySuffix(suffix: String, text: String): Option[ForeignFile] =
    val hasZero = text.contains('\u0000')
    suffix match
      case "obj" if !hasZero && text.linesIterator.exists(isOfObj) =>
        Some(ForeignFile(Model, "an OBJ mesh"))
      case "gltf" => Some(ForeignFile(Model, "a glTF model"))
      case "conf" if text.contains('{') || text.contains('=') =>
        Some(ForeignFile(Suite, "a benchmark suite"))
      case "ies" => Some(ForeignFile(Photometry, "an IES photometric file"))
      case _ if !hasZero => None
      case "stl" => Some(ForeignFile(Model, "an STL mesh"))
      case "blend" => Some(ForeignFile(Model, "a Blender file"))
      case "3ds" => Some(ForeignFile(Model, "a 3DS file"))
      case "tga" => Some(ForeignFile(Picture, "a TGA image"))
      case _ => None

  private def isOfObj(line: String): Boolean =
    Set("v", "vn", "vt", "f", "g", "mtllib", "usemtl")(line.trim.takeWhile(!_.isWhitespace))

  private def markup(text: String): Option[ForeignFile] =
    if text.startsWith("{") then
      val isModel = text.contains("\"asset\"") || text.contains("\"accessors\"")
      Some(if isModel then ForeignFile(Model, "a glTF model")
      else ForeignFile(Other, "a JSON file"))
    else if !text.startsWith("<") then None
    else if text.contains("<scene") then Some(ForeignFile(Mitsuba, "a Mitsuba scene"))
    else if text.contains("<COLLADA") then Some(ForeignFile(Model, "a COLLADA file"))
    else if text.contains("<svg") then Some(ForeignFile(Other, "an SVG image"))
    else if text.toLowerCase(Locale.ROOT).contains("<html") then
      Some(ForeignFile(Other, "an HTML page"))
    else Some(ForeignFile(Other, "an XML file"))

  /** Whether more than a tenth are control characters that texts don't have. */
  private def isBinary(text: String): Boolean =
    val isUtf16 = text.startsWith("\u00ff\u00fe") || text.startsWith("\u00fe\u00ff")
    !isUtf16 && text.count(c => c < ' ' && !TextControls(c)) * 10 > text.length

  private val TextControls = Set('\t', '\n', '\r', '\f', '\u000b', '\u001a', '\u001b')
