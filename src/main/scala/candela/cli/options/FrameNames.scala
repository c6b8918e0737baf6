package candela.cli.options

/** Names of files with a place for the number of a frame. */
private[cli] object FrameNames:
  private val Number = "%(0(\\d))?d".r

  /** Whether the name has a place for a number. */
  def hasNumber(name: String): Boolean = Number.findFirstIn(name).isDefined

  /** The name with a number in place of `%d` or `%04d`. */
  def numbered(name: String, n: Int): String =
    Number.replaceAllIn(name, m => n.toString.reverse.padTo(digits(m.group(2)), '0').reverse)

  private def digits(group: String | Null): Int = if group == null then 1 else group.toInt
