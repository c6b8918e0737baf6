package candela.scenefile

import scala.collection.IndexedSeqView
import scala.collection.mutable

import candela.base.{IntBuffer, SourcePos, loop}
import candela.math.{Motion, MotionRow, MotionRows}

/** Instances, of which there may be millions, in flat arrays: each is made when it is asked for.
  *
  * @param store which is not added to
  * @param which numbers in the store, those of this list from `from` on; null: all that there are
  */
final class InstanceList private (
    private val store: InstanceStore,
    private val which: Array[Int] | Null,
    from: Int,
    val length: Int
) extends scala.collection.immutable.AbstractSeq[InstanceDescription]
    with IndexedSeq[InstanceDescription]:

  private def number(i: Int): Int =
    val some = which
    if some == null then i else some(from + i)

  def apply(i: Int): InstanceDescription =
    if i < 0 || i >= length then throw IndexOutOfBoundsException(i)
    store(number(i))

  /** Whether it doesn't move, and has a transform that is neither perspective nor (nearly)
    * singular.
    */
  def isPlain(i: Int): Boolean = store.isPlain(number(i))

  /** How many are plain. */
  def plain: Int =
    var count = 0
    loop(length)(i => if isPlain(i) then count += 1)
    count

  /** Where they are. The motions of those that are not [[plain]] are made at once.
    *
    * @param make makes these
    */
  def motions(make: AnimatedTransform => Motion): IndexedSeqView[Motion] =
    val found = IntBuffer()
    loop(length)(i => if !isPlain(i) then found += i)
    val others = found.take()
    val made = others.map(i => make(store.other(number(i))))
    (0 until length).view.map: i =>
      val row = store.row(number(i))
      if row >= 0 then MotionRow(store.rows, row)
      else made(java.util.Arrays.binarySearch(others, i))

  /** The instances of each object, by its name. */
  def ofEach: Vector[(String, InstanceList)] =
    val names = store.names
    val sorted = names.distinct.sorted
    val ranks = sorted.zipWithIndex.toMap
    val rankOf = names.map(ranks).toArray
    // Where those of each begin in one array, which all lists have
    val starts = new Array[Int](sorted.size + 1)
    loop(length)(i => starts(rankOf(store.origin(number(i))) + 1) += 1)
    loop(sorted.size)(k => starts(k + 1) += starts(k))
    val next = starts.clone
    val numbers = new Array[Int](length)
    loop(length): i =>
      val k = rankOf(store.origin(number(i)))
      numbers(next(k)) = number(i)
      next(k) += 1
    sorted.indices.toVector.collect:
      case k if starts(k) < starts(k + 1) =>
        val count = starts(k + 1) - starts(k)
        sorted(k) ->
          (if count == length then this else new InstanceList(store, numbers, starts(k), count))

  override def partition(
      holds: InstanceDescription => Boolean
  ): (InstanceList, InstanceList) =
    val (in, out) = (IntBuffer(), IntBuffer())
    loop(length)(i => (if holds(this(i)) then in else out) += number(i))
    (some(in.take()), some(out.take()))

  private def some(numbers: Array[Int]): InstanceList =
    new InstanceList(store, numbers, 0, numbers.length)

  /** All of them, changed. */
  def changed(f: InstanceDescription => InstanceDescription): InstanceList =
    val builder = InstanceList.newBuilder
    loop(length)(i => builder += f(this(i)))
    builder.result()

object InstanceList:
  val Empty: InstanceList = newBuilder.result()

  def newBuilder: Builder = Builder()

  /** Adds instances to those of a list, which itself stays as it is. */
  final class Builder private[InstanceList] ()
      extends mutable.Builder[InstanceDescription, InstanceList]:
    private var store = InstanceStore.empty

    /** Whether a list has the store, too. */
    private var isGiven = false

    def addOne(one: InstanceDescription): this.type =
      if isGiven then
        store = store.continued
        isGiven = false
      store.add(one)
      this

    override def addAll(more: IterableOnce[InstanceDescription]): this.type = more match
      case list: InstanceList if store.length == 0 && list.which == null =>
        store = list.store
        isGiven = true
        this
      case _ => super.addAll(more)

    def clear(): Unit =
      store = InstanceStore.empty
      isGiven = false

    def result(): InstanceList =
      isGiven = true
      new InstanceList(store, null, 0, store.length)

/** What is known of instances. It is added to until a list has it: lists are read by any thread.
  *
  * @param numbers of each: its origin, line, column
  * @param others  those whose transform is not a row, in order; the rest have the rows in theirs
  */
private final class InstanceStore private (
    val rows: MotionRows,
    numbers: IntBuffer,
    private var origins: Vector[InstanceStore.Origin],
    private var others: Vector[InstanceStore.Other]
):
  import InstanceStore.*

  private val numberOf = mutable.HashMap.empty[Origin, Int]
  private var last = Origin("", "", None)
  private var lastNumber = -1

  private inline val NumbersPerInstance = 3

  def length: Int = numbers.length / NumbersPerInstance

  /** The same instances, to which others can be added; most memory is shared. */
  def continued: InstanceStore =
    new InstanceStore(rows.continued, numbers.continued, origins, others)

  def add(one: InstanceDescription): Unit =
    place(one.instanceToWorld)
    numbers += originOf(one)
    numbers += one.at.line
    numbers += one.at.column

  private def originOf(one: InstanceDescription): Int =
    val at = one.at
    val isLast = lastNumber >= 0 && (last.name == one.name) && (last.file eq at.file) &&
      (last.includedFrom eq at.includedFrom)
    if !isLast then
      last = Origin(one.name, at.file, at.includedFrom)
      lastNumber = numberOf.getOrElseUpdate(last, { origins :+= last; origins.size - 1 })
    lastNumber

  private def place(t: AnimatedTransform): Unit =
    val map = t.start
    if (map eq t.end) && !map.isFlat && MotionRows.canHold(map) then rows.add(map): Unit
    else others :+= Other(length, t)

  /** The names of all origins. */
  def names: Vector[String] = origins.map(_.name)

  /** The number of the origin of an instance. */
  def origin(i: Int): Int = numbers(NumbersPerInstance * i)

  def isPlain(i: Int): Boolean = row(i) >= 0

  /** The number of the row; −1 − that of another transform. */
  def row(i: Int): Int =
    val before = othersBefore(i)
    if before < others.size && others(before).number == i then -1 - before else i - before

  /** How many before `i` have no row. */
  private def othersBefore(i: Int): Int =
    var (low, high) = (0, others.size)
    while low < high do
      val middle = (low + high) >>> 1
      if others(middle).number < i then low = middle + 1 else high = middle
    low

  /** The transform of an instance that is not plain. */
  def other(i: Int): AnimatedTransform = others(-1 - row(i)).toWorld

  def apply(i: Int): InstanceDescription =
    val Origin(name, file, includedFrom) = origins(origin(i))
    val at = SourcePos(
      file,
      numbers(NumbersPerInstance * i + 1),
      numbers(NumbersPerInstance * i + 2),
      includedFrom
    )
    val toWorld =
      if isPlain(i) then GraphicsState.still(rows.transform(row(i))) else other(i)
    InstanceDescription(name, at, toWorld)

private object InstanceStore:
  final case class Origin(name: String, file: String, includedFrom: Option[SourcePos])

  /** The transform of the instance of a number. */
  final case class Other(number: Int, toWorld: AnimatedTransform)

  def empty: InstanceStore =
    new InstanceStore(MotionRows(), IntBuffer(), Vector.empty, Vector.empty)
