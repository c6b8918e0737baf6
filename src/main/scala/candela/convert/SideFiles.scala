package candela.convert

import java.nio.file.{Files, Path}
import java.security.MessageDigest

import candela.base.{Problem, SceneError, WholeFile}

/** Files that lie beside a written scene. They are named by what is in them: what is there already
  * under such a name is the same, or not ours to touch.
  */
final class SideFiles(val folder: Path):

  /** Puts the bytes into a file, whole or not at all; its name. */
  def add(kind: String, extension: String, bytes: Array[Byte]): String =
    val hash = MessageDigest.getInstance("SHA-256").digest(bytes)
    val name = s"$kind-${hash.take(8).map(b => f"$b%02x").mkString}.$extension"
    val path = folder.resolve(name)
    if !Files.exists(path) then WholeFile.write(path, bytes)
    else if !java.util.Arrays.equals(Files.readAllBytes(path), bytes) then
      throw SceneError(Problem.general(s"`$path` exists and holds something else"))
    name
