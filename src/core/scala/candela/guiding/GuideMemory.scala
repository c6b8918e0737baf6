package candela.guiding

import candela.base.FloatBuffer
import scala.collection.mutable.ArrayBuffer

/** Memory of the records of all passes of a rendering, which use it one after the other. What a
  * pass leaves to the garbage collector would otherwise add up: it collects when much is used.
  * Safe for use by several threads.
  */
private[guiding] final class GuideMemory:
  private val free = ArrayBuffer.empty[FloatBuffer]
  private var ofNumbers = Array.emptyFloatArray
  private var ofKeys = Array.emptyLongArray

  /** For one event. Not an array of the method that uses it: C2 of JDK 25 removes such an array and
    * takes its numbers from where they were copied from, although others are there by then.
    */
  val event = new Array[Float](GuideRecords.Size)

  /** An empty buffer, until it is given back. */
  def acquire(): FloatBuffer = synchronized:
    if free.isEmpty then FloatBuffer() else free.remove(free.length - 1)

  def giveBack(buffer: FloatBuffer): Unit = synchronized:
    buffer.clear()
    free.append(buffer): Unit

  /** At least `size` numbers, until this is asked for again. */
  def numbers(size: Int): Array[Float] =
    if ofNumbers.length < size then ofNumbers = new Array[Float](roomy(size))
    ofNumbers

  /** Likewise. */
  def keys(size: Int): Array[Long] =
    if ofKeys.length < size then ofKeys = new Array[Long](roomy(size))
    ofKeys

  /** Nothing is recorded any more. */
  def forget(): Unit = synchronized:
    free.clear()
    ofNumbers = Array.emptyFloatArray
    ofKeys = Array.emptyLongArray

  /** Passes differ a little in size. */
  private def roomy(size: Int): Int = (size * 1.1).toInt
