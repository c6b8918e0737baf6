package candela.base

import java.io.IOException
import java.nio.file.{AtomicMoveNotSupportedException, Files, Path}
import java.nio.file.{StandardCopyOption, StandardOpenOption}

/** Atomic file writes: a file is complete or absent, even if writing is interrupted. */
object WholeFile:

  def write(path: Path, bytes: Array[Byte]): Unit =
    write(path): file =>
      val _ = Files.write(file, bytes)

  /** Lets `body` write a temporary file beside `path`, then renames it to `path`.
    *
    * @throws IOException if it can't be written, or is a folder
    */
  def write(path: Path)(body: Path => Unit): Unit =
    if Files.isDirectory(path) then throw IOException("it is a folder")
    // Files.createTempFile would make the file readable by its owner only.
    val unique = s"${ProcessHandle.current.pid}-${System.nanoTime}"
    val temporary = path.resolveSibling(s".${path.getFileName}.$unique.tmp")
    try
      val _ = Files.write(temporary, Array.emptyByteArray, StandardOpenOption.CREATE_NEW)
      body(temporary)
      try
        val _ = Files.move(temporary, path, StandardCopyOption.ATOMIC_MOVE)
      catch
        case _: AtomicMoveNotSupportedException =>
          val _ = Files.move(temporary, path, StandardCopyOption.REPLACE_EXISTING)
    finally
      val _ = Files.deleteIfExists(temporary)
