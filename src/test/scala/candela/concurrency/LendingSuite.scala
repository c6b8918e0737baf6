package candela.concurrency

import java.nio.ByteBuffer

import org.scalatest.funsuite.AnyFunSuite

class LendingSuite extends AnyFunSuite:
  test("a buffer is used again, and no two at once are one"):
    val buffers = DirectBuffers(16)
    val first = buffers.lend: a =>
      buffers.lend(b => assert(a ne b))
      a.putInt(1).limit(8)
    val again = buffers.lend: a =>
      assert(a.position() == 0 && a.limit() == 16 && a.isDirect)
      a
    assert(again eq first)

  test("a body that fails gives its buffer back"):
    val buffers = DirectBuffers(16)
    var lent = Option.empty[ByteBuffer]
    assertThrows[IllegalStateException]:
      buffers.lend: a =>
        lent = Some(a)
        throw IllegalStateException()
    assert(buffers.lend(a => lent.contains(a) && lent.exists(_ eq a)))
