package candela.testing

import java.io.ByteArrayOutputStream
import java.util.zip.GZIPOutputStream

/** Makes gzip files. */
object Gzip:
  def of(content: Array[Byte]): Array[Byte] =
    val bytes = ByteArrayOutputStream()
    val zip = GZIPOutputStream(bytes)
    zip.write(content)
    zip.close()
    bytes.toByteArray
