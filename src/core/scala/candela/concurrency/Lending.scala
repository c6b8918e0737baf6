package candela.concurrency

import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN
import java.util.concurrent.ConcurrentLinkedDeque

/** Scratch memory that is lent and used again; there are as many pieces as are lent at once. Safe
  * for threads.
  *
  * @param make a piece, where all are lent
  */
final class Lending[A <: AnyRef](make: => A):
  private val free = ConcurrentLinkedDeque[A]()

  /** Lends a piece, as the last one left it, as long as the body runs. */
  def lend[B](body: A => B): B =
    val pooled = free.pollFirst()
    val piece = if pooled == null then make else pooled
    try body(piece)
    finally free.addFirst(piece)

/** Little-endian buffers of one size outside the heap, which are lent. The JVM frees those that are
  * given up only where it collects the old part of its heap, and it may never do that. Safe for
  * threads.
  *
  * @param bytes of each
  */
final class DirectBuffers(bytes: Int):
  private val lending = Lending(ByteBuffer.allocateDirect(bytes).order(LITTLE_ENDIAN))

  /** Lends an empty buffer as long as the body runs. */
  def lend[A](body: ByteBuffer => A): A = lending.lend(buffer => body(buffer.clear()))
