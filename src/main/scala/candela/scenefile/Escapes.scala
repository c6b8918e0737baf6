package candela.scenefile

import java.io.ByteArrayOutputStream
import java.nio.charset.StandardCharsets.UTF_8

/** What `\` and the byte after it mean in a quoted text. */
private object Escapes:
  private val Written = "nrtbf\\\"'"
  private val Meant = "\n\r\t\b\f\\\"'"

  /** The text between two places; or the place of a byte that has no meaning after `\`. */
  def unescaped(bytes: Array[Byte], from: Int, until: Int): Either[Int, String] =
    val out = ByteArrayOutputStream(until - from)
    var i = from
    var isKnown = true
    while i < until && isKnown do
      if bytes(i) != '\\' then out.write(bytes(i))
      else
        i += 1
        val meaning = Written.indexOf(bytes(i))
        isKnown = meaning >= 0
        if isKnown then out.write(Meant.charAt(meaning))
      if isKnown then i += 1
    if isKnown then Right(out.toString(UTF_8)) else Left(i)
