package candela.io

import java.nio.file.Path
import java.util.concurrent.ConcurrentHashMap

/** Digests of the files of a scene, taken while they are read: files may change afterwards. Safe
  * for threads.
  */
private[candela] final class ReadFiles:
  private val digests = ConcurrentHashMap[Path, String]()

  /** A file that was read with two contents has the digest of neither. */
  def note(file: Path, digest: String): Unit =
    digests.merge(
      ReadFiles.key(file),
      digest,
      (a, b) => if a == b then a else Sha256.of(s"$a $b")
    ): Unit

  /** None of a file that was not read as a whole. */
  def digest(file: Path): Option[String] = Option(digests.get(ReadFiles.key(file)))

private[candela] object ReadFiles:
  private def key(file: Path): Path = file.toAbsolutePath.normalize
