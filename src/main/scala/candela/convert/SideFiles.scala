package candela.convert

import java.nio.file.{AtomicMoveNotSupportedException, Files, Path, StandardCopyOption}
import java.nio.file.StandardOpenOption
import java.security.MessageDigest

import candela.base.{Problem, SceneError}

/** Files that lie beside a written scene. They are named by what is in them: what is there already
  * under such a name is the same, or not ours to touch.
  */
final class SideFiles(val folder: Path):

  /** Puts the bytes into a file, whole or not at all; its name. */
  def add(kind: String, extension: String, bytes: Array[Byte]): String =
    val hash = MessageDigest.getInstance("SHA-256").digest(bytes)
    val name = s"$kind-${hash.take(8).map(b => f"$b%02x").mkString}.$extension"
    val path = folder.resolve(name)
    if !Files.exists(path) then SideFiles.write(path)(Files.write(_, bytes))
    else if !java.util.Arrays.equals(Files.readAllBytes(path), bytes) then
      throw SceneError(Problem.general(s"`$path` exists and holds something else"))
    name

object SideFiles:

  /** Lets `body` write a new file beside `path`, which then takes its place. */
  def write(path: Path)(body: Path => Any): Unit =
    val unique = s"${ProcessHandle.current.pid}-${System.nanoTime}"
    val temporary = path.resolveSibling(s".${path.getFileName}.$unique.tmp")
    try
      val _ = Files.write(temporary, Array.emptyByteArray, StandardOpenOption.CREATE_NEW)
      val _ = body(temporary)
      try
        val _ = Files.move(temporary, path, StandardCopyOption.ATOMIC_MOVE)
      catch
        case _: AtomicMoveNotSupportedException =>
          val _ = Files.move(temporary, path, StandardCopyOption.REPLACE_EXISTING)
    finally
      val _ = Files.deleteIfExists(temporary)
