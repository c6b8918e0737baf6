package candela.scenefile

import candela.base.{IntBuffer, loop}
import candela.diagnostics.SourcePos
import scala.collection.IndexedSeqView
import scala.collection.mutable

import candela.math.{Motion, MotionRow, MotionRows}

/** Instances, of which there may be millions, in flat arrays: each is made when it is asked for.
  *
  * @param store which is not added to
  * @param selection numbers in the store, those of this list from `from` on; null: all of them
  */
final class InstanceList private (
    private val store: InstanceStore,
    private val selection: Array[Int] | Null,
    from: Int,
    val length: Int
) extends scala.collection.immutable.AbstractSeq[InstanceDescription]
    with IndexedSeq[InstanceDescription]:

  private def number(i: Int): Int =
    val numbers = selection
    if numbers == null then i else numbers(from + i)

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
    val nonPlainBuilder = IntBuffer()
    loop(length)(i => if !isPlain(i) then nonPlainBuilder += i)
    val nonPlain = nonPlainBuilder.drain()
    val nonPlainMotions = nonPlain.map(i => make(store.generalTransform(number(i))))
    (0 until length).view.map: i =>
      val row = store.row(number(i))
      if row >= 0 then MotionRow(store.rows, row)
      else nonPlainMotions(java.util.Arrays.binarySearch(nonPlain, i))

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
    val offsets = starts.clone
    val numbers = new Array[Int](length)
    loop(length): i =>
      val k = rankOf(store.origin(number(i)))
      numbers(offsets(k)) = number(i)
      offsets(k) += 1
    sorted.indices.toVector.collect:
      case k if starts(k) < starts(k + 1) =>
        val count = starts(k + 1) - starts(k)
        sorted(k) ->
          (if count == length then this else new InstanceList(store, numbers, starts(k), count))

  override def partition(
      holds: InstanceDescription => Boolean
  ): (InstanceList, InstanceList) =
    val (accepted, rejected) = (IntBuffer(), IntBuffer())
    loop(length)(i => (if holds(this(i)) then accepted else rejected) += number(i))
    (subset(accepted.drain()), subset(rejected.drain()))

  private def subset(numbers: Array[Int]): InstanceList =
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

    def addOne(instance: InstanceDescription): this.type =
      if isGiven then
        store = store.continued
        isGiven = false
      store.add(instance)
      this

    override def addAll(instances: IterableOnce[InstanceDescription]): this.type = instances match
      case list: InstanceList if store.length == 0 && list.selection == null =>
        store = list.store
        isGiven = true
        this
      case _ => super.addAll(instances)

    def clear(): Unit =
      store = InstanceStore.empty
      isGiven = false

    def result(): InstanceList =
      isGiven = true
      new InstanceList(store, null, 0, store.length)

/** What is known of instances. It is added to until a list has it: lists are read by any thread.
  *
  * @param numbers of each: its origin, line, column
  * @param general those whose transform is not a row, in order; the rest have the rows in theirs
  */
private final class InstanceStore private (
    val rows: MotionRows,
    numbers: IntBuffer,
    private var origins: Vector[InstanceStore.Origin],
    private var general: Vector[InstanceStore.GeneralTransform]
):
  import InstanceStore.*

  private val numberOf = mutable.HashMap.empty[Origin, Int]
  private var lastOrigin = Origin("", "", None)
  private var lastNumber = -1

  private inline val NumbersPerInstance = 3

  def length: Int = numbers.length / NumbersPerInstance

  /** The same instances, to which others can be added; most memory is shared. */
  def continued: InstanceStore =
    new InstanceStore(rows.continued, numbers.continued, origins, general)

  def add(instance: InstanceDescription): Unit =
    addTransform(instance.instanceToWorld)
    numbers += originOf(instance)
    numbers += instance.pos.line
    numbers += instance.pos.column

  private def originOf(instance: InstanceDescription): Int =
    val position = instance.pos
    val isLast =
      lastNumber >= 0 && (lastOrigin.name == instance.name) && (lastOrigin.file eq position.file) &&
        (lastOrigin.includedFrom eq position.includedFrom)
    if !isLast then
      lastOrigin = Origin(instance.name, position.file, position.includedFrom)
      lastNumber =
        numberOf.getOrElseUpdate(lastOrigin, { origins :+= lastOrigin; origins.size - 1 })
    lastNumber

  private def addTransform(t: AnimatedTransform): Unit =
    val map = t.start
    if (map eq t.end) && !map.isFlat && MotionRows.canHold(map) then rows.add(map): Unit
    else general :+= GeneralTransform(length, t)

  /** The names of all origins. */
  def names: Vector[String] = origins.map(_.name)

  /** The number of the origin of an instance. */
  def origin(i: Int): Int = numbers(NumbersPerInstance * i)

  def isPlain(i: Int): Boolean = row(i) >= 0

  /** The number of the row; −1 − that of another transform. */
  def row(i: Int): Int =
    val generalBefore = countGeneralBefore(i)
    if generalBefore < general.size && general(generalBefore).number == i then -1 - generalBefore
    else i - generalBefore

  /** How many before `i` have no row. */
  private def countGeneralBefore(i: Int): Int =
    var (low, high) = (0, general.size)
    while low < high do
      val middle = (low + high) >>> 1
      if general(middle).number < i then low = middle + 1 else high = middle
    low

  /** The transform of an instance that is not plain. */
  def generalTransform(i: Int): AnimatedTransform = general(-1 - row(i)).toWorld

  def apply(i: Int): InstanceDescription =
    val Origin(name, file, includedFrom) = origins(origin(i))
    val position = SourcePos(
      file,
      numbers(NumbersPerInstance * i + 1),
      numbers(NumbersPerInstance * i + 2),
      includedFrom
    )
    val toWorld =
      if isPlain(i) then GraphicsState.constant(rows.transform(row(i))) else generalTransform(i)
    InstanceDescription(name, position, toWorld)

private object InstanceStore:
  final case class Origin(name: String, file: String, includedFrom: Option[SourcePos])

  /** The transform of the instance of a number. */
  final case class GeneralTransform(number: Int, toWorld: AnimatedTransform)

  def empty: InstanceStore =
    new InstanceStore(MotionRows(), IntBuffer(), Vector.empty, Vector.empty)
