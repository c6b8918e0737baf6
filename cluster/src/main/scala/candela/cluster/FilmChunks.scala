package candela.cluster

import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.file.StandardOpenOption.{CREATE, READ, WRITE}
import java.nio.file.{Files, Path}

import scala.collection.mutable
import scala.util.Using

/** A part of a film file on its way.
  *
  * @param film  which of the films
  * @param index of the part
  */
final case class FilmChunk(film: Int, index: Int, bytes: Array[Byte])

/** Films travel in chunks: neither memory nor Spark's limit of 2 GB bounds their size. */
object FilmChunks:
  private val Size = 1 << 22

  /** Reads a film file, and deletes it at the end. */
  def read(film: Int, file: Path): Iterator[FilmChunk] =
    val count = ((Files.size(file) + Size - 1) / Size).toInt
    Iterator.range(0, count).map: i =>
      val chunk = Using.resource(FileChannel.open(file, READ)): channel =>
        val buffer = ByteBuffer.allocate(Math.min(Size, channel.size - i.toLong * Size).toInt)
        while buffer.hasRemaining && channel.read(buffer, i.toLong * Size + buffer.position()) > 0
        do ()
        FilmChunk(film, i, buffer.array)
      if i == count - 1 then Files.delete(file)
      chunk

  /** Writes film files, whatever the order of their chunks; returns them. */
  def write(chunks: Iterator[FilmChunk], folder: Path): Vector[Path] =
    val files = mutable.SortedMap.empty[Int, Path]
    for chunk <- chunks do
      val file = files.getOrElseUpdate(chunk.film, Files.createTempFile(folder, "film", ".film"))
      Using.resource(FileChannel.open(file, WRITE, CREATE)): channel =>
        val buffer = ByteBuffer.wrap(chunk.bytes)
        while buffer.hasRemaining do
          val _ = channel.write(buffer, chunk.index.toLong * Size + buffer.position())
    files.values.toVector
