package candela.scene

import candela.base.{IntBuffer, loop}
import candela.concurrency.Parallel
import java.util.Arrays

import candela.math.Transform
import candela.shapes.{BezierCurve, CurveBuilder, CurveForm, CurveGroup, Shape, ShapeGroup}

/** Collects the rows of a [[ShapeTable]], in the order of their numbers.
  *
  * Curves that follow one another, even those of many statements, share one
  * [[candela.shapes.CurveSegments]] while their space and form are the same.
  */
final class ShapeRows(parallel: Parallel):
  import ShapeRows.*

  private var groups = new Array[ShapeGroup | Null](64)
  private var size = 0
  private val materials = IntBuffer()

  /** Of all rows, once one emits. */
  private val lights = IntBuffer()
  private val inverted = java.util.BitSet()

  /** Curves whose segments are not made yet, and the number of their first one. */
  private var strands: CurveBuilder | Null = null
  private var firstOfStrands = 0

  def count: Int = size

  /** Adds a surface; its parameters as those of [[ShapeTable]]. */
  def add(shape: Shape, material: Int, light: Int, isInverted: Boolean): Unit =
    endStrands()
    addRows(1, material, light)
    groups(size - 1) = shape
    if isInverted then inverted.set(size - 1)

  /** Adds rows whose group is not known yet. */
  private def addRows(added: Int, material: Int, light: Int): Unit =
    if lights.length == 0 && light != ShapeTable.Dark then lights.add(ShapeTable.Dark, size)
    size = Math.addExact(size, added)
    if size > groups.length then
      groups = Arrays.copyOf(groups, Math.max(size, (2L * groups.length).min(MaxElements).toInt))
    materials.add(material, added)
    if lights.length > 0 || light != ShapeTable.Dark then lights.add(light, added)

  /** Adds the segments of curves, which do not emit; returns how many. */
  def addCurves(
      curves: IndexedSeq[BezierCurve],
      form: CurveForm,
      toWorld: Transform,
      isReversed: Boolean,
      material: Int
  ): Int =
    val builder = strandsOf(form, toWorld, isReversed)
    val oldCount = builder.count
    builder.add(curves, toWorld)
    val added = builder.count - oldCount
    addRows(added, material, ShapeTable.Dark)
    if builder.count >= MaxSegments then endStrands()
    added

  private def strandsOf(form: CurveForm, toWorld: Transform, isReversed: Boolean): CurveBuilder =
    val open = strands
    if open != null && open.accepts(form, toWorld, isReversed) then open
    else
      endStrands()
      val fresh = CurveBuilder(form, toWorld, isReversed)
      strands = fresh
      firstOfStrands = size
      fresh

  private def endStrands(): Unit =
    val open = strands
    if open != null then
      val group = CurveGroup(open.result(parallel), firstOfStrands)
      Arrays.fill(groups.asInstanceOf[Array[Object]], firstOfStrands, size, group)
      strands = null

  def result(): ShapeTable =
    endStrands()
    val flags = new Array[Boolean](if inverted.isEmpty then 0 else size)
    loop(flags.length)(i => flags(i) = inverted.get(i))
    val shapeGroups = Arrays.copyOf(groups, size).asInstanceOf[Array[ShapeGroup]]
    ShapeTable(shapeGroups, materials.drain(), lights.drain(), flags)

object ShapeRows:
  /** From which on the segments of curves are made: so many keep all threads busy, and the curves
    * that they are made from do not live long.
    */
  private val MaxSegments = 1 << 15

  /** Length of the largest arrays. */
  private val MaxElements = Int.MaxValue - 8L
