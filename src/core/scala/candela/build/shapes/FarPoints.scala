package candela.build.shapes

import candela.base.loop
import candela.math.{Position, Transform}
import candela.scenefile.{Declaration, Param}

/** Vertices with more digits than Floats have: models whose coordinates are far out themselves.
  *
  * A transform that takes them near the origin of what is built cancels their first digits, and the
  * rests matter (see [[Param.rests]]). They are then subtracted in Double from the point that it
  * takes to that origin.
  */
private[build] object FarPoints:
  /** Factor by which coordinates must shrink: four of 24 bits are lost. */
  private val Shrinks = 16.0

  /** The point from which to measure, if the rests matter. */
  def middle(p: Array[Float], rests: Array[Float], toWorld: Transform): Option[Position] =
    val m = toWorld.m
    def isCancelled(i: Int): Boolean =
      def row(r: Int) =
        val (x, y, z) = (m(r) * p(i), m(r + 1) * p(i + 1), m(r + 2) * p(i + 2))
        (Math.abs(x) + Math.abs(y) + Math.abs(z), Math.abs(x + y + z + m(r + 3)))
      val rows = Seq(row(0), row(4), row(8))
      rows.map(_._2).max * Shrinks < rows.map(_._1).max
    Option.when(
      rests.length > 0 && toWorld.isAffine && !toWorld.isFlat &&
        Iterator.range(0, p.length - 2, 3).exists(isCancelled)
    )(toWorld.inverse.position(Position.Origin))

  /** The points relative to `origin`. */
  def relative(p: Array[Float], rests: Array[Float], origin: Position): Array[Float] =
    val offset = Array(origin.x, origin.y, origin.z)
    val points = new Array[Float](p.length)
    loop(p.length)(i => points(i) = (p(i) - offset(i % 3) + rests(i)).toFloat)
    points

  /** A shape of points relative to another origin, which is returned, too. */
  def recentred(d: Declaration, toWorld: Transform): Option[(Declaration, Position)] =
    def replaced(p: Param, values: Array[Float], origin: Position) =
      (d.copy(params = d.params.map(q => if q eq p then p.withFloats(values) else q)), origin)
    d.param("P").filter(_.rests.length > 0) match
      case Some(p) =>
        middle(p.floats, p.rests, toWorld).map(o =>
          replaced(p, relative(p.floats, p.rests, o), o)
        )
      case None =>
        for
          p <- d.param("Pw") if p.rests.length > 0 && p.floats.length % 4 == 0
          // The first point decides: weights are not part of the coordinates
          o <- middle(first(p), Array(0f, 0f, 0f), toWorld)
        yield replaced(p, weighted(p, o), o)

  private def first(p: Param): Array[Float] =
    Array.tabulate(3)(k => (p.number(k) / p.number(3)).toFloat)

  private def weighted(p: Param, origin: Position): Array[Float] =
    val offset = Array(origin.x, origin.y, origin.z, 0.0)
    Array.tabulate(p.floats.length): i =>
      (p.number(i) - offset(i % 4) * p.number(i / 4 * 4 + 3)).toFloat
