package candela.models

import candela.diagnostics.{Code, Visible}
import candela.io.{FileName, InputFile, IoReason, SceneFolder}

import java.io.IOException
import java.net.URLDecoder
import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_8}
import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.Path
import java.util.Base64

import scala.collection.mutable

/** The JSON of a model, its buffers, and the images that they contain.
  *
  * Source: glTF 2.0 specification, §3.6 on buffers, §4.4 on the binary format.
  *
  * @param bins    buffers without `uri`, by their indices
  * @param library materials that are MTL's, by their indices; beyond it, they are glTF's
  */
private[models] final class GltfFile(
    session: Session,
    val root: Json,
    bins: Int => ByteBuffer,
    val library: Vector[MtlMaterial] = Vector.empty
):
  private val views = root.list("bufferViews")
  private val buffers = root.list("buffers")
  private val opened = mutable.HashMap.empty[Int, ByteBuffer]

  private def buffer(index: Json): ByteBuffer =
    val entry = index.element(buffers, "buffers")
    opened.getOrElseUpdate(
      index.size, {
        val length = entry.required("byteLength").size
        val all = entry("uri").fold(bins(index.size))(bytes)
        if all.remaining < length then
          entry.fail(s"`byteLength` is $length, but there are ${all.remaining} bytes")
        all.duplicate.order(ByteOrder.LITTLE_ENDIAN).limit(all.position() + length)
      }
    )

  private val decompressed = mutable.HashMap.empty[Int, ByteBuffer]

  /** The bytes of a buffer view, decompressed if it is compressed. */
  def view(index: Json): ByteBuffer =
    val entry = index.element(views, "buffer views")
    val compressed = GltfFile.Compressions.iterator.flatMap(entry.extension(_)).nextOption()
    compressed match
      case Some(e) =>
        decompressed.getOrElseUpdate(index.size, decoded(entry, e)).duplicate
          .order(ByteOrder.LITTLE_ENDIAN)
      case None => range(entry)

  private def decoded(entry: Json, compressed: Json): ByteBuffer =
    val (count, stride) =
      (compressed.required("count").size, compressed.required("byteStride").size)
    val (length, found) = (entry.required("byteLength").size, count.toLong * stride)
    if length != found then
      compressed.fail(s"$count elements of $stride bytes are not the $length bytes of the view")
    session.folder.allowance.countBytes(found, session.file, Some(compressed.at))
    val bytes = GltfFile.array(range(compressed))
    val (mode, filter) =
      (compressed.required("mode").text, compressed.text("filter").getOrElse("NONE"))
    try Meshopt.decode(bytes, count, stride, mode, filter)
    catch case e: DamagedStream => compressed.fail(e.getMessage)

  /** The bytes of a buffer that an entry names. */
  private def range(entry: Json): ByteBuffer =
    val all = buffer(entry.required("buffer"))
    val (from, length) = (entry.size("byteOffset", 0), entry.required("byteLength").size)
    if from.toLong + length > all.remaining then
      entry.fail(
        s"bytes $from to ${from.toLong + length} are not in the buffer, of ${all.remaining} bytes"
      )
    all.slice(all.position() + from, length).order(ByteOrder.LITTLE_ENDIAN)

  /** Bytes from one element of a buffer view to the next, if it says so. */
  def stride(index: Json): Option[Int] =
    index.element(views, "buffer views")("byteStride").map(_.size)

  private def bytes(uri: Json): ByteBuffer = data(uri) match
    case Some(bytes) => ByteBuffer.wrap(bytes)
    case None => file(uri).fold(ByteBuffer.allocate(0))(GltfFile.mapped(_, uri))

  /** The file of a URI. */
  private def file(uri: Json): Option[InputFile] =
    val name = fileName(uri)
    val located = session.folder.locate(name, Some(uri.at))
    located match
      case Some(file) => session.note(file.path)
      case None =>
        val (message, help) =
          session.folder.absence(name, Some(uri.at), s"no such file: `$name`")
        session.missing(uri.at, message, "using nothing", help)
    located

  /** The name of a file that is read where it is; it may be missing. */
  def linked(uri: Json): String =
    if uri.text.startsWith("data:") then uri.fail("expected the name of a file, found data")
    val name = fileName(uri)
    session.folder.locate(name, Some(uri.at)).foreach(file => session.note(file.path))
    name

  private def fileName(uri: Json): String =
    val text = uri.text
    if GltfFile.Scheme.findPrefixOf(text).isDefined && !text.startsWith("data:") then
      Session.fail(
        uri.at,
        "addresses of other schemes than files are not supported",
        Code.Unsupported
      )
    val name =
      try URLDecoder.decode(text.replace("+", "%2B"), UTF_8)
      catch case _: IllegalArgumentException => text
    if SceneFolder.isName(name) then name else uri.fail(s"`$name` is not a valid file name")

  private def data(uri: Json): Option[Array[Byte]] =
    val text = uri.text
    Option.when(text.startsWith("data:")):
      val comma = text.indexOf(',')
      if comma < 0 || !text.take(comma).endsWith(";base64") then
        uri.fail("expected data in base64")
      try Base64.getDecoder.decode(text.drop(comma + 1))
      catch case _: IllegalArgumentException => uri.fail("the base64 of the data is damaged")

  private val contents = mutable.LinkedHashMap.empty[String, ByteBuffer]

  /** Files within the model, by the names of [[imageName]]. */
  def parts: Map[String, ByteBuffer] = contents.toMap

  /** The name of an image file, which may be missing. */
  def imageName(image: Json): String = image("uri") match
    case Some(uri) =>
      data(uri).map(bytes => part(image, ByteBuffer.wrap(bytes))).getOrElse:
        val name = fileName(uri)
        val located = session.folder.locate(name, Some(uri.at))
        located.foreach(file => session.note(file.path))
        // All others are read where they are
        val converted = located.filter(_ => GltfFile.Converted(FileName.suffix(Path.of(name))))
        converted.fold(name)(file => part(image, GltfFile.mapped(file, uri)))
    case None =>
      image("bufferView") match
        case Some(index) => part(image, view(index))
        case None => image.fail("an image must have `uri` or `bufferView`")

  private def part(image: Json, bytes: ByteBuffer): String =
    val isWebP = WebPImages.contains(bytes)
    val readable = if isWebP then WebPImages.png(bytes, session, image.at) else bytes
    def starts(second: Char) =
      readable.remaining > 4 && readable.get(readable.position() + 1) == second.toByte
    if starts('K') then
      val message = "images in KTX2 are not supported"
      Session.fail(image.at, message, Code.Unsupported, Remedies.of("KHR_texture_basisu"))
    val suffix = if starts('P') then "png" else "jpg"
    val name = s"${session.file.getFileName}#${image.pointer}.$suffix"
    contents(name) = readable
    name

private[models] object GltfFile:
  private val Scheme = "[A-Za-z][A-Za-z0-9+.-]+:".r

  /** Of buffer views. */
  val Compressions: Vector[String] = Vector("EXT_meshopt_compression", "KHR_meshopt_compression")

  /** Suffixes of images that are read here. */
  private val Converted = Set("webp", "ktx2")

  private inline val Magic = 0x46546c67
  private inline val JsonChunk = 0x4e4f534a
  private inline val BinaryChunk = 0x004e4942

  /** A `.glb` or `.gltf` file. */
  def read(session: Session): GltfFile =
    val at = session.at("")
    try
      val all = session.folder.scene(session.file).map().order(ByteOrder.LITTLE_ENDIAN)
      if all.remaining >= 4 && all.getInt(all.position()) == Magic then binary(session, all)
      else
        if FileName.suffix(session.file) == "glb" then checkIsText(session, array(all))
        of(session, all)
    catch
      case e: IOException =>
        Session.fail(at, s"can't read the model: ${IoReason(e)}", Code.Unreadable)

  private def of(session: Session, text: ByteBuffer): GltfFile =
    GltfFile(session, Json.parse(array(text), session), _ => ByteBuffer.allocate(0))

  /** A `.glb` file may have the contents of a `.gltf` file, but no others. */
  private def checkIsText(session: Session, bytes: Array[Byte]): Unit =
    if !bytes.find(!_.toChar.isWhitespace).contains('{'.toByte) then
      val start = Visible.line(String(bytes.take(Integer.BYTES), ISO_8859_1))
      val message = s"not a valid .glb file: it begins with `$start`, not `glTF`"
      Session.fail(session.at(""), message, Code.UnknownFormat)

  def ofText(session: Session, text: String): GltfFile =
    of(session, ByteBuffer.wrap(text.getBytes(UTF_8)))

  private def array(bytes: ByteBuffer): Array[Byte] =
    val all = new Array[Byte](bytes.remaining)
    val _ = bytes.duplicate.get(all)
    all

  private def binary(session: Session, all: ByteBuffer): GltfFile =
    def fail(message: String) = Session.fail(session.at(""), message)
    if all.limit < 12 then fail("the file ends early")
    val version = all.getInt(4)
    if version != 2 then fail(s"expected glTF 2, found version $version")
    var json, bin = Option.empty[ByteBuffer]
    var from = 12L
    while from + 8 <= all.limit do
      val length = all.getInt(from.toInt)
      if length < 0 || from + 8 + length > all.limit then fail("the file ends early")
      val chunk = all.slice(from.toInt + 8, length)
      all.getInt(from.toInt + 4) match
        case JsonChunk if json.isEmpty => json = Some(chunk)
        case BinaryChunk if bin.isEmpty => bin = Some(chunk)
        case _ => ()
      from += 8L + length
    val text = json.getOrElse(fail("the file has no JSON"))
    val binary = bin.getOrElse(ByteBuffer.allocate(0))
    GltfFile(session, Json.parse(array(text), session), _ => binary)

  private def mapped(file: InputFile, uri: Json): ByteBuffer =
    try file.map()
    catch
      case e: IOException =>
        Session.fail(uri.at, s"can't read `$file`: ${IoReason(e)}", Code.Unreadable)
