package candela.accel.building

/** Ints one after the other, without boxes. */
private[building] final class IntBuffer(capacity: Int):
  private var all = new Array[Int](Math.max(16, capacity))
  var length = 0

  def +=(x: Int): Unit =
    if length == all.length then all = java.util.Arrays.copyOf(all, FloatBuffer.more(length))
    all(length) = x
    length += 1

  def copyTo(to: Array[Int], at: Int): Unit = System.arraycopy(all, 0, to, at, length)

/** Floats one after the other. */
private[building] final class FloatBuffer(capacity: Int):
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

private[building] object FloatBuffer:
  /** Half as much again, as long as arrays can be. */
  def more(length: Int): Int = Math.min(length + length / 2L + 16, Int.MaxValue - 8L).toInt
