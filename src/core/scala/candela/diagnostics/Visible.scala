package candela.diagnostics

import java.util.Locale

/** Text without power over a terminal: control characters, and those that only change how others
  * are shown, become visible. So do halves of surrogate pairs.
  */
object Visible:

  /** `text` as one line. Tabs stay. */
  def line(text: String): String = escaped(text, keepsLines = false)

  /** Line ends and tabs stay. */
  def text(text: String): String = escaped(text, keepsLines = true)

  private def escaped(text: String, keepsLines: Boolean): String =
    if text.forall(c => c >= ' ' && c < Delete) then text
    else
      val result = StringBuilder(text.length + 16)
      text.codePoints.forEach: c =>
        if c == '\t' || (c == '\n' && keepsLines) then result += c.toChar: Unit
        else if c < ' ' then result += (Pictures + c).toChar: Unit
        else if c == Delete then result += DeletePicture: Unit
        else if isSeen(c) then result ++= Character.toString(c): Unit
        else result ++= "<U+%04X>".formatLocal(Locale.ROOT, c): Unit
      result.toString

  private def isSeen(c: Int): Boolean = Character.getType(c).toByte match
    case Character.FORMAT => Joiners(c) // others are marks of direction and the like
    case Character.CONTROL | Character.SURROGATE | Character.LINE_SEPARATOR |
        Character.PARAGRAPH_SEPARATOR => false
    case _ => true

  private inline val Delete = 0x7f
  private inline val DeletePicture = '\u2421'

  /** The picture of the character 0; the other 31 follow. */
  private inline val Pictures = 0x2400

  /** Parts of words and emoji. */
  private val Joiners = Set(0x200c, 0x200d)
