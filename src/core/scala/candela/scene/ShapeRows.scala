package candela.scene

import scala.collection.mutable.ArrayBuffer

import candela.base.{IntBuffer, Parallel, loop}
import candela.math.Transform
import candela.shapes.{BezierCurve, CurveBuilder, CurveForm, CurveSegment, Shape}

/** Collects the rows of a [[ShapeTable]], in the order of their numbers.
  *
  * Curves that follow one another, even those of many statements, share one
  * [[candela.shapes.CurveSegments]] while their space and form are the same.
  */
final class ShapeRows(parallel: Parallel):
  private val shapes = ArrayBuffer.empty[Shape | Null]
  private val materials, lights = IntBuffer()
  private val inverted = java.util.BitSet()
  private var emit = false

  /** Curves whose segments are not made yet, and the number of their first one. */
  private var strands: CurveBuilder | Null = null
  private var firstOfStrands = 0

  def count: Int = shapes.length

  /** Adds a surface; its parameters as those of [[ShapeTable]]. */
  def add(shape: Shape, material: Int, light: Int, isInverted: Boolean): Unit =
    endStrands()
    addRow(shape, material, light)
    if isInverted then inverted.set(count - 1)

  private def addRow(shape: Shape | Null, material: Int, light: Int): Unit =
    shapes += shape
    materials += material
    lights += light
    emit |= light != ShapeTable.Dark

  /** Adds the segments of curves, which do not emit; returns how many. */
  def addCurves(
      curves: IndexedSeq[BezierCurve],
      form: CurveForm,
      toWorld: Transform,
      isReversed: Boolean,
      material: Int
  ): Int =
    val made = strandsOf(form, toWorld, isReversed)
    val before = made.count
    made.add(curves, toWorld)
    val more = made.count - before
    loop(more)(_ => addRow(null, material, ShapeTable.Dark))
    if made.count >= ShapeRows.MostSegments then endStrands()
    more

  private def strandsOf(form: CurveForm, toWorld: Transform, isReversed: Boolean): CurveBuilder =
    val open = strands
    if open != null && open.takes(form, toWorld, isReversed) then open
    else
      endStrands()
      val fresh = CurveBuilder(form, toWorld, isReversed)
      strands = fresh
      firstOfStrands = count
      fresh

  private def endStrands(): Unit =
    val open = strands
    if open != null then
      val segments = open.result(parallel)
      loop(segments.count)(i => shapes(firstOfStrands + i) = CurveSegment(segments, i))
      strands = null

  def result(): ShapeTable =
    endStrands()
    val all = new Array[Shape](count)
    loop(count)(i => all(i) = shapes(i).nn)
    val flags = new Array[Boolean](if inverted.isEmpty then 0 else count)
    loop(flags.length)(i => flags(i) = inverted.get(i))
    ShapeTable(all, materials.take(), if emit then lights.take() else Array.emptyIntArray, flags)

object ShapeRows:
  /** From which on the segments of curves are made: so many keep all threads busy, and the curves
    * that they are made from do not live long.
    */
  private val MostSegments = 1 << 15
