package candela.scenefile

/** Floats of a list whose length is not known yet; used again for list after list. */
final class FloatBuffer:
  private var data = new Array[Float](64)
  private var size = 0

  def add(value: Float): Unit =
    if size == data.length then data = java.util.Arrays.copyOf(data, size * 2)
    data(size) = value
    size += 1

  /** The values so far; the buffer is empty afterwards. */
  def take(): Array[Float] =
    val values = java.util.Arrays.copyOf(data, size)
    size = 0
    values

/** The same for Ints. */
final class IntBuffer:
  private var data = new Array[Int](64)
  private var size = 0

  /** Has a number lost its fraction? */
  var sawFraction = false

  def add(value: Int): Unit =
    if size == data.length then data = java.util.Arrays.copyOf(data, size * 2)
    data(size) = value
    size += 1

  /** The values so far; the buffer is empty afterwards. */
  def take(): Array[Int] =
    val values = java.util.Arrays.copyOf(data, size)
    size = 0
    sawFraction = false
    values
