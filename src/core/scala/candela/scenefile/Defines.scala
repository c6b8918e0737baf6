package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_8}
import java.util.regex.Matcher.quoteReplacement

import scala.collection.mutable

/** Values that a user gives to `$NAME` in pbrt files. They are put in place before a file is split
  * into tokens, so columns in messages count them. pbrt itself has no parameters; other words with
  * a `$` stay as they are.
  *
  * @param usedElsewhere names that need no use here
  */
final class Defines(values: Map[String, String], usedElsewhere: Set[String] = Set.empty):
  private val referenced = mutable.HashSet.empty[String]
  private val names = mutable.HashSet.empty[String]

  /** The same source with the values in it; comments stay as they are. */
  def substitute(source: Source): Source =
    if values.isEmpty then source
    else
      val bytes = source.remaining().getOrElse:
        val message = s"`${source.name}` is too large for values of -D"
        throw SceneError(Problem.general(Code.TooLarge, message))
      if !bytes.contains('$'.toByte) then Source(source.name, bytes)
      else
        // Latin-1, since it keeps all bytes
        val text = String(bytes, ISO_8859_1)
        val replaced = Defines.Piece.replaceAllIn(text, m => quoteReplacement(piece(m.matched)))
        Source(source.name, replaced.getBytes(ISO_8859_1))

  /** Names that have taken their values. */
  def usedNames: Set[String] = referenced.toSet

  /** @throws SceneError if a value is of a name that no file has */
  def requireUse(): Unit =
    for name <- (values.keySet -- referenced -- usedElsewhere).minOption do
      val help = Suggest.help(name, names.toSet -- referenced)
      val message = s"the scene has no parameter `$$$name`"
      throw SceneError(Problem.general(Code.SceneParameter, message, help))

  private def piece(text: String): String =
    if text.startsWith("#") then text
    else Defines.Name.replaceAllIn(text, m => quoteReplacement(value(m.group(1), m.matched)))

  private def value(name: String, written: String): String =
    names += name
    values.get(name).fold(written): value =>
      referenced += name
      String(value.getBytes(UTF_8), ISO_8859_1)

object Defines:
  val Nothing: Defines = Defines(Map.empty)

  /** `NAME`, if a word is `$NAME`. */
  def nameIn(word: String): Option[String] = word match
    case Name(name) => Some(name)
    case _ => None

  private val Name = raw"\$$(\w+)".r

  /** A string, a comment, or a name. */
  private val Piece = ("\"[^\"\\\\\n]*+(?:\\\\.[^\"\\\\\n]*+)*+\"|#[^\r\n]*+|" + Name).r
