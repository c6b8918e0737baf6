package candela.io

import java.io.{InputStream, IOException, OutputStream}

/** Takes in a content, for its digest. */
private[candela] trait ContentDigest:
  def add(bytes: Array[Byte], from: Int, length: Int): Unit

  /** Of all that was added. */
  def result(): String

/** Digests the whole content, also what its reader leaves.
  *
  * @param digest takes it in
  * @param note   receives the digest when the stream is closed, unless a part of it can't be read
  */
private[candela] final class Digesting(in: InputStream, digest: ContentDigest, note: String => Unit)
    extends InputStream:
  private val single = new Array[Byte](1)
  private var isOpen = true
  private var hasFailed = false

  override def read(): Int = if read(single, 0, 1) < 0 then -1 else single(0) & 0xff

  override def read(into: Array[Byte], from: Int, length: Int): Int =
    hasFailed = true
    val n = in.read(into, from, length)
    hasFailed = false
    if n > 0 then digest.add(into, from, n)
    n

  override def available(): Int = in.available()

  override def close(): Unit =
    if isOpen then
      isOpen = false
      try
        if !hasFailed then
          transferTo(OutputStream.nullOutputStream): Unit
          note(digest.result())
      catch case _: IOException => () // who needs the digest reads the file again
      finally in.close()
