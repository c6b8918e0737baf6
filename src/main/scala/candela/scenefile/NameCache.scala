package candela.scenefile

/** Makes Strings of a file's words. The few names that occur again and again are made once, and
  * know their hash.
  */
private final class NameCache:
  private val known = new Array[String](NameCache.Slots)

  /** The text of `source` between two places of its window. */
  def of(source: Source, from: Int, until: Int): String =
    val bytes = source.bytes
    var hash = until - from
    var i = from
    while i < until do
      hash = hash * 31 + bytes(i)
      i += 1
    val slot = (hash ^ (hash >>> 16)) & (NameCache.Slots - 1)
    if !isSame(known(slot), bytes, from, until) then known(slot) = source.text(from, until)
    known(slot)

  /** Never so for texts with bytes beyond ASCII, which are no names. */
  private def isSame(name: String, bytes: Array[Byte], from: Int, until: Int): Boolean =
    name != null && name.length == until - from && {
      var i = 0
      while i < name.length && name.charAt(i) == bytes(from + i) do i += 1
      i == name.length
    }

private object NameCache:
  private val Slots = 256
