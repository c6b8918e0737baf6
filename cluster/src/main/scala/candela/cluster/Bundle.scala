package candela.cluster

import java.io.{ByteArrayInputStream, ByteArrayOutputStream, IOException, SequenceInputStream}
import java.nio.file.{Files, Path}
import java.security.MessageDigest
import java.util.HexFormat
import java.util.zip.{Deflater, ZipEntry, ZipInputStream, ZipOutputStream}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** A scene and its files, packed into one.
  *
  * @param scene  name of the scene file in it
  * @param digest SHA-256 of the bytes
  * @param parts  the bytes: several arrays, as one holds at most 2 GB
  */
final case class Bundle(scene: String, digest: String, parts: Vector[Array[Byte]]):
  def size: Long = parts.map(_.length.toLong).sum

  /** Writes the files below a folder; returns the scene file.
    *
    * @throws IOException if the bytes are not those of the digest
    */
  def unpack(folder: Path): Path =
    if Bundle.digest(parts) != digest then throw IOException(s"the bundle of $scene is damaged")
    val streams = parts.iterator.map(ByteArrayInputStream(_)).asJavaEnumeration
    Using.resource(ZipInputStream(SequenceInputStream(streams))): zip =>
      for entry <- Iterator.continually(zip.getNextEntry).takeWhile(_ != null) do
        val file = folder.resolve(entry.getName)
        val _ = Files.createDirectories(file.getParent)
        val _ = Files.copy(zip, file)
    folder.resolve(scene)

object Bundle:
  private val PartSize = 1 << 24

  /** Packs files by their names relative to the folder that contains all. Equal files are equal
    * bundles. They are not compressed: Spark does so where it sends them.
    */
  def of(scene: Path, files: Vector[Path]): Bundle =
    def normalized(path: Path) = path.toAbsolutePath.normalize
    val folder = files.map(normalized(_).getParent).foldLeft(normalized(scene).getParent):
      (common, other) =>
        Iterator.iterate(common)(_.getParent).find(other.startsWith(_)).get
    def name(file: Path) = folder.relativize(normalized(file)).iterator.asScala.mkString("/")
    val output = Parts()
    Using.resource(ZipOutputStream(output)): zip =>
      zip.setLevel(Deflater.NO_COMPRESSION)
      for file <- (scene +: files).distinctBy(name).sortBy(name) do
        val entry = ZipEntry(name(file))
        entry.setTime(0)
        zip.putNextEntry(entry)
        val _ = Files.copy(file, zip)
    Bundle(name(scene), digest(output.chunks), output.chunks)

  private def digest(parts: Vector[Array[Byte]]): String =
    val sum = MessageDigest.getInstance("SHA-256")
    parts.foreach(sum.update(_))
    HexFormat.of.formatHex(sum.digest)

  private final class Parts extends java.io.OutputStream:
    private val last = ByteArrayOutputStream(PartSize)
    private var full = Vector.empty[Array[Byte]]

    def chunks: Vector[Array[Byte]] = if last.size == 0 then full else full :+ last.toByteArray

    def write(b: Int): Unit =
      last.write(b)
      cut()

    override def write(bytes: Array[Byte], from: Int, count: Int): Unit =
      last.write(bytes, from, count)
      cut()

    private def cut(): Unit = if last.size >= PartSize then
      full :+= last.toByteArray
      last.reset()
