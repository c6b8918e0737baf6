package candela.growth

/** Counts what the classes of a [[CountingLoader]] do: calls, rounds of loops, and elements that
  * are made or copied.
  */
object Operations:
  private var number = 0L

  def count: Long = number
  def add(): Unit = number += 1
  def add(elements: Int): Unit = number += elements
