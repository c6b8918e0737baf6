package candela.scenefile

import scala.collection.IndexedSeqView
import scala.collection.mutable

import candela.base.{IntBuffer, SourcePos, loop}
import candela.math.{Motion, MotionRow, MotionRows}

/** Instances, of which there may be millions, in flat arrays: each is made when it is asked for.
  *
  * @param which of the store; null: the first `length`
  */
final class InstanceList private (
    private val store: InstanceStore,
    private val which: Array[Int] | Null,
    val length: Int
) extends scala.collection.immutable.AbstractSeq[InstanceDescription]
    with IndexedSeq[InstanceDescription]:

  private def number(i: Int): Int =
    val some = which
    if some == null then i else some(i)

  def apply(i: Int): InstanceDescription =
    if i < 0 || i >= length then throw IndexOutOfBoundsException(i)
    store(number(i))

  /** Whether no instance moves, and no transform is perspective or singular. */
  def arePlain: Boolean =
    var i = 0
    while i < length && store.isPlain(number(i)) do i += 1
    i == length

  /** Where they are, if [[arePlain]]. */
  def motions: IndexedSeqView[Motion] =
    (0 until length).view.map(i => MotionRow(store.rows, store.row(number(i))))

  /** The instances of each object, by its name. */
  def ofEach: Vector[(String, InstanceList)] =
    val names = mutable.LinkedHashMap.empty[String, IntBuffer]
    loop(length): i =>
      names.getOrElseUpdate(store.name(number(i)), IntBuffer()) += number(i)
    if names.size == 1 then Vector(names.head._1 -> this)
    else
      names.toVector.sortBy(_._1).map: (name, found) =>
        val those = found.take()
        name -> new InstanceList(store, those, those.length)

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
    private var store = InstanceStore()
    private var length = 0

    def addOne(one: InstanceDescription): this.type =
      if !store.add(one, length) then
        // Another list has added to it
        val before = result()
        store = InstanceStore()
        loop(before.length)(i => store.add(before(i), i): Unit)
        store.add(one, length): Unit
      length += 1
      this

    override def addAll(more: IterableOnce[InstanceDescription]): this.type = more match
      case list: InstanceList if length == 0 && list.which == null =>
        store = list.store
        length = list.length
        this
      case _ => super.addAll(more)

    def clear(): Unit =
      store = InstanceStore()
      length = 0

    def result(): InstanceList = new InstanceList(store, null, length)

/** What is known of instances: numbers that are added, and never changed. */
private final class InstanceStore:
  import InstanceStore.*

  val rows: MotionRows = MotionRows()

  /** Of each: its origin, line, column, and the number of its row; −1 − that of its transform. */
  private val numbers = IntBuffer()
  private val origins = mutable.ArrayBuffer.empty[Origin]
  private val numberOf = mutable.HashMap.empty[Origin, Int]
  private val others = mutable.ArrayBuffer.empty[AnimatedTransform]
  private var last = Origin("", "", None)
  private var lastNumber = -1

  private inline val Each = 4

  /** Adds the instance `i`, unless there is one already. */
  def add(one: InstanceDescription, i: Int): Boolean = synchronized:
    val isNext = numbers.length == Each * i
    if isNext then
      numbers += origin(one)
      numbers += one.at.line
      numbers += one.at.column
      numbers += place(one.instanceToWorld)
    isNext

  private def origin(one: InstanceDescription): Int =
    val at = one.at
    val isLast = lastNumber >= 0 && (last.name == one.name) && (last.file eq at.file) &&
      (last.includedFrom eq at.includedFrom)
    if !isLast then
      last = Origin(one.name, at.file, at.includedFrom)
      lastNumber = numberOf.getOrElseUpdate(last, { origins += last; origins.size - 1 })
    lastNumber

  private def place(t: AnimatedTransform): Int =
    val map = t.start
    if (map eq t.end) && !map.isFlat && MotionRows.canHold(map) then rows.add(map)
    else
      others += t
      -others.size

  def isPlain(i: Int): Boolean = row(i) >= 0
  def row(i: Int): Int = numbers(Each * i + 3)
  def name(i: Int): String = origins(numbers(Each * i)).name

  def apply(i: Int): InstanceDescription =
    val Origin(name, file, includedFrom) = origins(numbers(Each * i))
    val at = SourcePos(file, numbers(Each * i + 1), numbers(Each * i + 2), includedFrom)
    val place = row(i)
    val toWorld =
      if place < 0 then others(-1 - place) else GraphicsState.still(rows.transform(place))
    InstanceDescription(name, at, toWorld)

private object InstanceStore:
  final case class Origin(name: String, file: String, includedFrom: Option[SourcePos])
