package candela.build.media

import candela.io.{InputFile, IoReason, Sha256}
import java.io.IOException
import java.nio.channels.Channels
import java.nio.charset.StandardCharsets.UTF_8

import scala.collection.mutable
import scala.util.Using

import candela.math.Transform
import candela.media.VoxelTree

/** A grid of a NanoVDB file.
  *
  * @param toIndex the grid's space to the voxels' indices, affine
  * @param low     lowest indices of the active voxels
  * @param high    highest indices, inclusive
  */
final class NanoVdbGrid(
    val tree: VoxelTree,
    val toIndex: Transform,
    val low: Vector[Int],
    val high: Vector[Int]
)

/** A NanoVDB file can't be read: the cause, on one line. */
final class NanoVdbError(message: String) extends RuntimeException(message, null, false, false)

/** Reads grids of floats from NanoVDB files, version 32, uncompressed or by ZIP.
  *
  * Source: the layout documented in NanoVDB's `NanoVDB.h` and `util/IO.h`, openvdb.org.
  */
object NanoVdbFile:
  private val HeaderSize = 16
  private val MetaSize = 176
  private val Marks = Vector("NanoVDB0", "NanoVDB2")
  private val Version = 32
  private val Codecs = Vector("no compression", "ZIP", "BLOSC")
  private val LongestName = 1 << 16

  /** The first grid of this name, or the names of all grids.
    *
    * @throws NanoVdbError if the file is damaged or of another kind
    */
  def read(input: InputFile, name: String): Either[Vector[String], NanoVdbGrid] =
    try
      Using.resource(input.channel()): channel =>
        input.note(Sha256.ofRest(Channels.newInputStream(channel)))
        val file = FileBytes(channel, 0, channel.size)
        entries(file) match
          case all if all.exists(_.name == name) =>
            val entry = all.find(_.name == name).get
            if entry.codec != 0 then input.unpacks(Math.max(0, entry.size))
            Right(NanoVdbTree.read(entry.bytes(file)))
          case others => Left(others.map(_.name))
    catch
      case e: IOException =>
        throw NanoVdbError(IoReason(e))
      case _: OutOfMemoryError => throw NanoVdbError("not enough memory for its voxels")

  /** A grid's place in the file. */
  private final case class Entry(name: String, at: Long, stored: Long, size: Long, codec: Int):
    def bytes(file: GridBytes): GridBytes =
      if codec == 0 && stored != size then
        throw NanoVdbError(s"byte $at: grid `$name` has $stored bytes, expected $size")
      Codecs.lift(codec) match
        case Some("no compression") => file.slice(at, stored)
        case Some("ZIP") => InflatedBytes.of(file, at, stored, size)
        case other =>
          val coding = other.getOrElse(s"compression number $codec")
          throw NanoVdbError(
            s"grid `$name` is stored with $coding, expected none or ZIP (`nanovdb_convert -z`)"
          )

  private def entries(file: GridBytes): Vector[Entry] =
    val result = mutable.ArrayBuffer.empty[Entry]
    var position = 0L
    while position < file.size do
      val header = file.read(position, HeaderSize)
      val mark = UTF_8.decode(header.slice(0, 8)).toString
      if !Marks.contains(mark) then
        val problem = if position == 0 then "not a NanoVDB file" else "damaged"
        throw NanoVdbError(s"$problem: byte $position must begin with `${Marks.head}`")
      val version = header.getInt(8) >>> 21
      if version != Version then
        throw NanoVdbError(s"it has version $version of the format, expected $Version")
      val (count, codec) = (header.getShort(12) & 0xffff, header.getShort(14) & 0xffff)
      position += HeaderSize
      val described = Vector.fill(count):
        val meta = file.read(position, MetaSize)
        val (size, stored, length) = (meta.getLong(0), meta.getLong(8), meta.getInt(136))
        if size < 0 || stored < 0 || length < 1 || length > LongestName then
          throw NanoVdbError(s"byte $position: the description of a grid is damaged")
        val name = UTF_8.decode(file.read(position + MetaSize, length)).toString.takeWhile(_ != 0)
        position += MetaSize + length
        (name, size, stored)
      for (name, size, stored) <- described do
        if stored > file.size - position then
          throw NanoVdbError(s"the file is cut short: $stored bytes at $position of ${file.size}")
        result += Entry(name, position, stored, size, codec)
        position += stored
    if result.isEmpty then throw NanoVdbError("the file is empty")
    result.toVector
