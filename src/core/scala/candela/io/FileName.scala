package candela.io

import java.nio.file.Path
import java.util.Locale

/** File names, and the suffixes that determine the format. */
object FileName:

  /** Is the name that of an image whose numbers are light as it is? */
  def isOfFloats(path: Path): Boolean = Set("exr", "hdr", "pic", "pfm")(suffix(path))

  /** The text after the last dot, in lower case; empty if there is no dot. */
  def suffix(path: Path): String =
    val name = last(path)
    val dot = name.lastIndexOf('.')
    if dot < 0 then "" else name.substring(dot + 1).toLowerCase(Locale.ROOT)

  /** The name without folders and suffix; a leading dot starts no suffix. */
  def stem(path: Path): String =
    val name = last(path)
    val dot = name.lastIndexOf('.')
    if dot > 0 then name.take(dot) else name

  def withSuffix(path: Path, suffix: String): Path = path.resolveSibling(s"${stem(path)}.$suffix")

  private def last(path: Path): String = Option(path.getFileName).fold("")(_.toString)
