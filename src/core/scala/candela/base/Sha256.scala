package candela.base

import java.io.InputStream
import java.nio.charset.StandardCharsets.UTF_8
import java.security.MessageDigest
import java.util.HexFormat

import scala.util.Using

/** What tells contents from others: SHA-256 (FIPS 180-4), in 64 hexadecimal digits. */
object Sha256:
  def of(text: String): String = hex(start().digest(text.getBytes(UTF_8)))

  /** Of all that a stream still has, which is closed then.
    *
    * @throws java.io.IOException if it can't be read
    */
  def ofAll(stream: => InputStream): String =
    val sum = start()
    Using.resource(stream): in =>
      val buffer = new Array[Byte](1 << 16)
      var count = in.read(buffer)
      while count >= 0 do
        sum.update(buffer, 0, count)
        count = in.read(buffer)
    hex(sum.digest)

  private def start() = MessageDigest.getInstance("SHA-256")

  private def hex(digest: Array[Byte]) = HexFormat.of.formatHex(digest)
