package candela.shapes

import candela.base.loop

/** One parameter of a NURBS surface: the B-spline basis over a knot vector.
  *
  * @param count number of control points
  * @param order degree + 1
  * @param knots `count + order` non-decreasing numbers
  */
final class KnotVector(val count: Int, val order: Int, val knots: Array[Double]):
  private val degree = order - 1

  /** First of the `order` control points that influence t. At a knot, the span below applies. */
  def first(t: Double): Int =
    var span = degree
    while span < count - 1 && (t > knots(span + 1) || knots(span) == knots(span + 1)) do span += 1
    // Empty spans at the end: use the previous span
    while span > degree && knots(span) == knots(span + 1) do span -= 1
    span - degree

  /** Weights of those control points at t, and their derivatives: two arrays of `order`.
    *
    * Source: Cox–de Boor; Piegl and Tiller, "The NURBS Book", 2nd ed., §2.5, equations 2.5 and 2.7.
    */
  def weights(t: Double): (Array[Double], Array[Double]) =
    val span = first(t) + degree
    var lower = Array(1.0)
    var current = Array(1.0)
    for p <- 1 to degree do
      lower = current
      current = raise(lower, span, p, t)
    val slopes = Array.tabulate(order): j =>
      val i = span - degree + j
      val left = if j > 0 then ratio(lower(j - 1), knots(i + degree) - knots(i)) else 0.0
      val right = if j < degree then ratio(lower(j), knots(i + order) - knots(i + 1)) else 0.0
      degree * (left - right)
    (current, slopes)

  /** The p + 1 non-zero basis functions of degree p, from the p of one degree less. */
  private def raise(lower: Array[Double], span: Int, p: Int, t: Double): Array[Double] =
    Array.tabulate(p + 1): j =>
      val i = span - p + j
      val rising =
        if j > 0 then lower(j - 1) * ratio(t - knots(i), knots(i + p) - knots(i)) else 0.0
      val falling =
        if j < p then
          lower(j) * ratio(knots(i + p + 1) - t, knots(i + p + 1) - knots(i + 1))
        else 0.0
      rising + falling

  private def ratio(a: Double, b: Double): Double = if b == 0 then 0.0 else a / b

/** A NURBS surface, evaluated as a grid of vertices.
  *
  * @param points four numbers per control point, x·w, y·w, z·w and w, in rows of constant v
  */
final class Nurbs(u: KnotVector, v: KnotVector, points: Array[Double]):

  /** Position and ∂p/∂u × ∂p/∂v (zero at a pole): six numbers. */
  def at(s: Double, t: Double): Array[Double] =
    val (wu, du) = u.weights(s)
    val (wv, dv) = v.weights(t)
    val i0 = u.first(s)
    val j0 = v.first(t)
    val p, pu, pv = new Array[Double](4)
    loop(v.order): j =>
      loop(u.order): i =>
        val c = 4 * ((j0 + j) * u.count + i0 + i)
        loop(4): k =>
          p(k) += wu(i) * wv(j) * points(c + k)
          pu(k) += du(i) * wv(j) * points(c + k)
          pv(k) += wu(i) * dv(j) * points(c + k)
    // (P/w)' = (P' − w'·P/w)/w
    val x = Array.tabulate(3)(k => p(k) / p(3))
    val xu = Array.tabulate(3)(k => (pu(k) - pu(3) * x(k)) / p(3))
    val xv = Array.tabulate(3)(k => (pv(k) - pv(3) * x(k)) / p(3))
    Array(
      x(0),
      x(1),
      x(2),
      xu(1) * xv(2) - xu(2) * xv(1),
      xu(2) * xv(0) - xu(0) * xv(2),
      xu(0) * xv(1) - xu(1) * xv(0)
    )
