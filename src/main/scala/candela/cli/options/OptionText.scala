package candela.cli.options

/** The texts of an option: a short one, which `--help` prints, and what only pages add, in Markdown
  * whose links start at `docs`. Rows of scopt hold one text, so that a line end parts the two.
  */
private[cli] object OptionText:

  def apply(short: String, more: String): String =
    if more.isEmpty then short else s"$short\n$more"

  /** What `--help` prints of the text of a row. */
  def short(text: String): String = text.takeWhile(_ != '\n')

  /** All of it, as sentences. */
  def sentences(text: String): String =
    text.split('\n').map(_.trim).filter(_.nonEmpty).map(sentence).mkString(" ")

  /** With a capital at the start and a full stop. */
  def sentence(text: String): String =
    val first = text.takeWhile(!_.isWhitespace)
    val isWord = first.forall(c => c.isLetter || "-,:".contains(c))
    val start = if isWord then text.capitalize else text
    if start.endsWith(".") then start else s"$start."

  private val Link = """\[([^\]]*)\]\([^)]*\)""".r

  /** Markdown's links as their words. */
  def unlinked(text: String): String = Link.replaceAllIn(
    text,
    m =>
      java.util.regex.Matcher.quoteReplacement(m.group(1))
  )
