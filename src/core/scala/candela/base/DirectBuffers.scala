package candela.base

import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN
import java.util.concurrent.ConcurrentLinkedDeque

/** Little-endian buffers of one size outside the heap, which are lent and used again. The JVM frees
  * those that are given up only where it collects the old part of its heap, and it may never do
  * that. Safe for threads.
  *
  * @param bytes of each
  */
final class DirectBuffers(bytes: Int):
  private val free = ConcurrentLinkedDeque[ByteBuffer]()

  /** Lends an empty buffer as long as the body runs; there are as many as are lent at once. */
  def lend[A](body: ByteBuffer => A): A =
    val buffer = Option(free.pollFirst()).getOrElse(ByteBuffer.allocateDirect(bytes))
    try body(buffer.clear().order(LITTLE_ENDIAN))
    finally free.addFirst(buffer)
