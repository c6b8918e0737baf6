package candela.io

import candela.io.Sha256.Numbers
import candela.concurrency.Parallel
import java.io.ByteArrayInputStream

import org.scalatest.funsuite.AnyFunSuite

import candela.render.ThreadPool

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

  private def digest(parallel: Parallel, parts: Numbers*) =
    Sha256.hex(Sha256.ofNumbers(parts, parallel))

  test("the digest of numbers is that of their bits, in their order, for any number of threads"):
    val many = Array.tabulate(1_000_003)(_ * 0.37f)
    val before = digest(Parallel.Alone, Numbers(many))
    assert(digest(ThreadPool(3), Numbers(many)) == before)
    for i <- Seq(0, 131_072, 1_000_002) do
      val changed = many.clone
      changed(i) = Math.nextUp(changed(i))
      assert(digest(Parallel.Alone, Numbers(changed)) != before, i)
    val zero = digest(Parallel.Alone, Numbers(Array(0f)))
    assert(digest(Parallel.Alone, Numbers(Array(-0f))) != zero)

  test("parts of other lengths have another digest, though their numbers are the same"):
    val all = Array(1, 2, 3)
    val whole = digest(Parallel.Alone, Numbers(all))
    val parts = digest(Parallel.Alone, Numbers(all, 0, 1), Numbers(all, 1, 3))
    assert(whole != parts && whole == digest(Parallel.Alone, Numbers(Array(0, 1, 2, 3), 1, 4)))
