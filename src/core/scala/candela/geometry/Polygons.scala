package candela.geometry

import candela.base.loop

/** Divides polygons into triangles: convex ones into a fan, others by cutting off ears.
  *
  * Source: Meisters, "Polygons Have Ears", The American Mathematical Monthly 82(6), 1975.
  */
final class Polygons:
  private var x, y = Array.emptyDoubleArray
  private var previous, next = Array.emptyIntArray
  private var isReflex = Array.emptyBooleanArray

  /** Calls `emit` with the corners of each triangle, numbers below `count`. A polygon that meets
    * itself, or of more than [[Polygons.MaxReflex]] reflex corners, is a fan as well as can be.
    *
    * @param vertex of a corner, an index in `points`
    */
  def triangulate(points: Array[Float], count: Int)(vertex: Int => Int)(
      emit: (Int, Int, Int) => Unit
  ): Unit =
    if count == 3 then emit(0, 1, 2)
    else if count > 3 then
      project(points, count, vertex)
      var reflexCount = 0
      loop(count): i =>
        isReflex(i) = turn(previous(i), i, next(i)) < 0
        if isReflex(i) then reflexCount += 1
      if reflexCount == 0 || reflexCount > Polygons.MaxReflex then
        loop(count - 2)(i => emit(0, i + 1, i + 2))
      else cutEars(count, emit)

  /** Onto the plane of two axes in which the polygon is largest, anticlockwise. */
  private def project(points: Array[Float], count: Int, vertex: Int => Int): Unit =
    if x.length < count then
      val room = Integer.highestOneBit(count) << 1
      x = new Array[Double](room)
      y = new Array[Double](room)
      previous = new Array[Int](room)
      next = new Array[Int](room)
      isReflex = new Array[Boolean](room)
    // Newell's normal
    val n = new Array[Double](3)
    loop(count): i =>
      val (a, b) = (3 * vertex(i), 3 * vertex(if i + 1 == count then 0 else i + 1))
      loop(3): k =>
        val (u, v) = ((k + 1) % 3, (k + 2) % 3)
        n(k) += (points(a + u).toDouble - points(b + u)) * (points(a + v).toDouble + points(b + v))
      previous(i) = if i == 0 then count - 1 else i - 1
      next(i) = if i + 1 == count then 0 else i + 1
    val axis = (0 until 3).maxBy(k => Math.abs(n(k)))
    val (first, second) = ((axis + 1) % 3, (axis + 2) % 3)
    val (u, v) = if n(axis) < 0 then (second, first) else (first, second)
    loop(count): i =>
      x(i) = points(3 * vertex(i) + u)
      y(i) = points(3 * vertex(i) + v)

  /** Twice the signed area of a triangle. */
  private def turn(a: Int, b: Int, c: Int): Double =
    (x(b) - x(a)) * (y(c) - y(a)) - (x(c) - x(a)) * (y(b) - y(a))

  private def cutEars(count: Int, emit: (Int, Int, Int) => Unit): Unit =
    var remaining = count
    var ear = 0
    var passed = 0 // corners since the last ear
    while remaining > 3 do
      // A polygon without ears meets itself: any corner will do
      if passed >= remaining || isEar(ear, remaining) then
        val (a, c) = (previous(ear), next(ear))
        emit(a, ear, c)
        next(a) = c
        previous(c) = a
        remaining -= 1
        if isReflex(a) then isReflex(a) = turn(previous(a), a, c) < 0
        if isReflex(c) then isReflex(c) = turn(a, c, next(c)) < 0
        passed = 0
        ear = next(c) // not the neighbour, so that triangles are less slender
      else
        passed += 1
        ear = next(ear)
    emit(previous(ear), ear, next(ear))

  private def isEar(b: Int, remaining: Int): Boolean =
    val (a, c) = (previous(b), next(b))
    turn(a, b, c) > 0 && {
      var i = next(c)
      var isFree = true
      loop(remaining - 3): _ =>
        if isFree && isReflex(i) then isFree = !isWithin(i, a, b, c)
        i = next(i)
      isFree
    }

  /** Whether a corner lies in a triangle and is none of its corners: holes are often bridged by
    * edges whose ends are there twice.
    */
  private def isWithin(p: Int, a: Int, b: Int, c: Int): Boolean =
    turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0 &&
      !isSame(p, a) && !isSame(p, b) && !isSame(p, c)

  private def isSame(p: Int, q: Int): Boolean = x(p) == x(q) && y(p) == y(q)

object Polygons:
  /** The time to cut ears grows with the product of corners and reflex corners. */
  val MaxReflex = 4096
