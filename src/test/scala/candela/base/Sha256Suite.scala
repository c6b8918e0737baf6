package candela.base

import java.io.ByteArrayInputStream

import org.scalatest.funsuite.AnyFunSuite

class Sha256Suite extends AnyFunSuite:

  test("the digest of a text is that of FIPS 180-4"):
    val abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    assert(Sha256.of("abc") == abc)

  test("a stream longer than any buffer has the digest of the same text"):
    val text = "pixels " * 100_000
    var isClosed = false
    val stream = new ByteArrayInputStream(text.getBytes("UTF-8")):
      override def close(): Unit = isClosed = true
    assert(Sha256.ofAll(stream) == Sha256.of(text) && isClosed)
