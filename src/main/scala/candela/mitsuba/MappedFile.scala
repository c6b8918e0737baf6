package candela.mitsuba

import java.io.IOException
import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.file.{Path, StandardOpenOption}

import scala.util.Using

/** Binary files, in memory as the system sees fit. */
private[mitsuba] object MappedFile:

  /** @throws IOException if it can't be read, or is larger than 2 GB */
  def read(path: Path): ByteBuffer =
    Using.resource(FileChannel.open(path, StandardOpenOption.READ)): channel =>
      if channel.size > Int.MaxValue then throw IOException("larger than 2 GB")
      channel.map(FileChannel.MapMode.READ_ONLY, 0, channel.size)
