package candela.build.shapes

import candela.diagnostics.SceneError
import candela.io.InputFile
import java.io.{ByteArrayInputStream, IOException}
import java.util.zip.GZIPInputStream

import candela.scenefile.Source

/** Roughly how large the mesh of a PLY file is, by the beginning of the file: no larger than the
  * file can hold.
  *
  * @param corners of a face, on average
  * @param numbers of a vertex that are kept
  */
final case class PlySize(vertices: Long, faces: Long, corners: Double, numbers: Int):
  /** Of elements that take a byte or more each. */
  private def limited(bytes: Long): PlySize =
    copy(vertices = Math.min(vertices, bytes), faces = Math.min(faces, bytes))

object PlySize:

  /** None if the file can't be read. */
  def guess(file: InputFile): Option[PlySize] =
    guess(file, UsualHeader).orElse(guess(file, Beginning))

  /** @param most bytes of the file that are read */
  private def guess(file: InputFile, most: Int): Option[PlySize] =
    try
      val start = file.beginning(most)
      val isPacked = start.length > 1 && start(0) == 0x1f && start(1) == 0x8b.toByte
      val text =
        if isPacked then GZIPInputStream(ByteArrayInputStream(start)).readNBytes(Beginning / 4)
        else start
      val header = PlyHeader.read(Source(file.toString, text), (_, m) => throw IOException(m))
      Some(size(header, if isPacked then 0 else file.size)
        .limited(file.size * (if isPacked then Source.MaxDeflateRatio else 1)))
    catch case _: IOException | _: SceneError => None

  private def size(header: PlyHeader, length: Long): PlySize =
    def named(name: String) = header.elements.find(_.name == name)
    val vertex = named("vertex")
    val properties = vertex.toSet.flatMap(_.properties.map(_.name))
    val numbers = 3 + (if properties("nx") then 3
                       else 0) + (if properties("u") || properties("s") then 2 else 0)
    val faces = named("face").fold(0L)(_.count.toLong)
    val isBinary = header.format != PlyFormat.Ascii && length > 0 && faces > 0
    val lists = named("face").fold(Vector.empty)(_.properties.filter(_.countType.nonEmpty))
    val corners = lists match
      case Vector(list) if isBinary =>
        val otherBytes =
          header.elements.filter(_.name != "face").map(e => e.count.toLong * bytes(e))
        val bytesPerFace = (length - header.bodyStart - otherBytes.sum).toDouble / faces
        val beside = named("face").fold(0)(bytes(_)) + list.countType.fold(0)(_.bytes)
        Math.max(3.0, Math.min(MaxCorners, (bytesPerFace - beside) / list.valueType.bytes))
      case _ => 3.0
    PlySize(vertex.fold(0L)(_.count.toLong), faces, corners, numbers)

  /** Of an element, without lists. */
  private def bytes(element: PlyElement): Int =
    element.properties.filter(_.countType.isEmpty).map(_.valueType.bytes).sum

  private val UsualHeader = 1 << 11
  private val Beginning = 1 << 16
  private val MaxCorners = 8.0
