package candela.accel

/** Ints one after the other, without boxes. */
private[accel] final class IntBuffer(capacity: Int):
  private var all = new Array[Int](Math.max(16, capacity))
  var length = 0

  def +=(x: Int): Unit =
    if length == all.length then all = java.util.Arrays.copyOf(all, FloatBuffer.more(length))
    all(length) = x
    length += 1

  def copyTo(to: Array[Int], at: Int): Unit = System.arraycopy(all, 0, to, at, length)

/** Floats one after the other. */
private[accel] final class FloatBuffer(capacity: Int):
  private var all = new Array[Float](Math.max(16, capacity))
  var length = 0

  /** Makes room for `n` more and answers where they are. */
  def grow(n: Int): Int =
    val at = length
    length = Math.addExact(length, n)
    if length > all.length then
      all = java.util.Arrays.copyOf(all, Math.max(length, FloatBuffer.more(all.length)))
    at

  def update(i: Int, x: Float): Unit = all(i) = x

  /** The array itself, until the next call of `grow`. */
  def floats: Array[Float] = all

  def copyTo(to: Array[Float], at: Int): Unit = System.arraycopy(all, 0, to, at, length)

private[accel] object FloatBuffer:
  /** Half as much again, as long as arrays can be. */
  def more(length: Int): Int = Math.min(length + length / 2L + 16, Int.MaxValue - 8L).toInt

/** Rows of Floats numbered from 1, one for each level of a recursion. */
private[accel] final class FloatStack(width: Int):
  private val rows = new Array[Float](130 * (width + 1))

  /** A row for what is not decided yet. */
  val found = new Array[Float](width + 1)

  def apply(level: Int, k: Int): Float = rows(level * (width + 1) + k)
  def update(level: Int, k: Int, x: Float): Unit = rows(level * (width + 1) + k) = x
  def keep(from: Int, to: Int): Unit =
    System.arraycopy(rows, from * (width + 1), rows, to * (width + 1), width + 1)
  def fill(level: Int, x: Float): Unit =
    java.util.Arrays.fill(rows, level * (width + 1), (level + 1) * (width + 1), x)
