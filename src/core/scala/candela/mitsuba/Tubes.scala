package candela.mitsuba

import candela.base.{FloatBuffer, IntBuffer, loop}
import candela.math.*

/** Meshes of Mitsuba's curves, which are round tubes. */
object Tubes:
  /** Uniform cubic B-splines, open at their ends. v runs over all segments. */
  def splines(curves: Vector[CurvePoints]): Mesh =
    val segments = curves.map(_.points.size - 3).sum
    val builder = TubeBuilder(segments, ringsOfSegment = 16)
    var firstSegment = 0
    for c <- curves do
      builder.beginTube()
      val segmentCount = c.points.size - 3
      for s <- 0 until segmentCount; step <- 0 to builder.steps if step > 0 || s == 0 do
        val t = step.toDouble / builder.steps
        val v = (firstSegment + s + t) / segments
        builder.ring(Spline.ring(c, s, t), v.toFloat)
      firstSegment += segmentCount
    builder.mesh

  /** Straight segments between balls, each a capsule. */
  def capsules(curves: Vector[CurvePoints]): Mesh =
    val segments = curves.map(_.points.size - 1).sum
    val builder = TubeBuilder(segments, ringsOfSegment = 18)
    var firstSegment = 0
    for c <- curves do
      for s <- 0 until c.points.size - 1 do
        builder.beginTube()
        val (p, q) = (c.points(s), c.points(s + 1))
        val length = (q - p).length
        val axis = if length > 0f then (q - p) * (1f / length) else Vec3.Z
        val slope = if length > 0f then (c.radii(s) - c.radii(s + 1)) / length else 0f
        val border = Math.asin(clamp(slope, -1f, 1f).toDouble)
        val caps = Math.max(2, builder.steps / 2)
        for end <- 0 to 1; step <- 0 to caps do
          val t = step.toDouble / caps
          val tilt =
            if end == 0 then lerp(t, -Math.PI / 2, border) else lerp(t, border, Math.PI / 2)
          val (axial, radial) = (Math.sin(tilt).toFloat, Math.max(0.0, Math.cos(tilt)).toFloat)
          val r = c.radii(s + end)
          val middle = c.points(s + end) + axis * (r * axial)
          builder.ring(
            Ring(middle, axis, r * radial, radial, axis * axial),
            (firstSegment + end).toFloat / segments
          )
        firstSegment += 1
    builder.mesh

  /** Straight segments of equal radius, mitred where they meet and open at their ends. */
  def polylines(fibres: Vector[HairFile.Fibre], radius: Float): Mesh =
    val builder = TubeBuilder(fibres.map(_.size - 1).sum, ringsOfSegment = 8)
    for fibre <- fibres do
      val segments = fibre.size - 1
      val directions = fibre.zip(fibre.drop(1)).map((a, b) => (b - a).normalized)
      for s <- 0 until segments do
        builder.beginTube()
        for end <- 0 to 1 do
          val (tangent, neighbour) =
            (directions(s), directions(clamp(s + 2 * end - 1, 0, segments - 1)))
          val across = tangent + neighbour
          val cosine = across dot tangent
          // Of acute angles, the ends are not as long as they would be
          val slope = if cosine > 0.5f then across * (1f / cosine) else tangent
          builder.ring(
            Ring(fibre(s + end), tangent, radius, 1f, Vec3.Zero, slope = slope - tangent),
            (s + end).toFloat / segments
          )
    builder.mesh

  private def lerp(t: Double, a: Double, b: Double): Double = (1 - t) * a + t * b

/** A circle of a tube.
  *
  * @param across,along of the normal: `across` times the direction from the middle, plus `along`
  * @param slope        by how much a point at a distance lies before the circle's plane
  */
private[mitsuba] final case class Ring(
    middle: Vec3,
    tangent: Vec3,
    radius: Float,
    across: Float,
    along: Vec3,
    bend: Vec3 = Vec3.Zero,
    slope: Vec3 = Vec3.Zero
)

/** Segments of uniform cubic B-splines. */
private[mitsuba] object Spline:
  /** The circle at `t`, 0 to 1, of the segment that begins with the control point `first`. */
  def ring(c: CurvePoints, segment: Int, t: Double): Ring =
    val s = 1 - t
    def blended(w: Array[Double]) =
      def weighted(i: Int) = c.points(segment + i) * w(i).toFloat
      weighted(0) + weighted(1) + weighted(2) + weighted(3)
    def radius(w: Array[Double]) =
      def weighted(i: Int) = w(i) * c.radii(segment + i)
      (weighted(0) + weighted(1) + weighted(2) + weighted(3)).toFloat
    val value = Array(
      s * s * s / 6,
      (3 * t * t * t - 6 * t * t + 4) / 6,
      (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6,
      t * t * t / 6
    )
    val slope =
      Array(-s * s / 2, (3 * t * t - 4 * t) / 2, (-3 * t * t + 2 * t + 1) / 2, t * t / 2)
    val bend = Array(s, 3 * t - 2, 1 - 3 * t, t)
    val (d, r) = (blended(slope), radius(value))
    val length2 = d.lengthSquared
    // Where the tube widens, its normal leans back (the derivative of the radius)
    if length2 > 0f then
      Ring(
        blended(value),
        d.normalized,
        r,
        1f,
        d * (-radius(slope) / length2),
        blended(bend) * (1f / length2)
      )
    else Ring(blended(value), Vec3.Z, r, 1f, Vec3.Zero)

/** Joins rings by triangles.
  *
  * @param segments       of all curves: they share a budget of triangles
  * @param ringsOfSegment at most
  */
private[mitsuba] final class TubeBuilder(segments: Int, ringsOfSegment: Int):
  /** Rings of each segment. */
  val steps: Int =
    val fits = Math.sqrt(TubeBuilder.Budget / (4.0 * Math.max(1, segments))).toInt
    clamp(fits, 2, ringsOfSegment)
  private val sides = clamp(2 * steps, 6, 32)

  // Seen from the side, the polygon is as wide as the circle, on average
  private val swell = (Math.PI / sides / Math.sin(Math.PI / sides)).toFloat

  private val positions, normals, uvs = FloatBuffer()
  private val indices = IntBuffer()
  private var side, tangent = Vec3.Zero
  private var turn = 0.0
  private var rings = 0
  private var isFirst = true

  /** The next ring begins a tube. */
  def beginTube(): Unit = isFirst = true

  def ring(r: Ring, v: Float): Unit =
    val (x, y) = TubeBuilder.axes(r.tangent)
    if isFirst then
      side = x
      turn = 0.0
    else
      // The side that turns least from the last ring
      val flat = side - r.tangent * (side dot r.tangent)
      side = if flat.lengthSquared > 1e-12f then flat.normalized else x
      val angle = Math.atan2((side dot y).toDouble, (side dot x).toDouble) / (2 * Math.PI)
      turn = angle + Math.rint(turn - angle)
    tangent = r.tangent
    val bitangent = tangent cross side
    loop(sides + 1): k =>
      val phi = 2 * Math.PI * (k % sides) / sides
      val outward = side * Math.cos(phi).toFloat + bitangent * Math.sin(phi).toFloat
      val reach = r.radius * swell
      push(positions, r.middle + outward * reach - r.tangent * (reach * (outward dot r.slope)))
      // The normal of a bent tube leans by the radius
      val lean = 1f - r.radius * (outward dot r.bend)
      push(normals, (outward * (r.across * lean) + r.along).normalized)
      uvs += (turn + k.toDouble / sides).toFloat
      uvs += v
    if !isFirst then
      loop(sides): k =>
        val (a, b) = ((rings - 1) * (sides + 1) + k, rings * (sides + 1) + k)
        triangle(a, a + 1, b)
        triangle(b, a + 1, b + 1)
    rings += 1
    isFirst = false

  private def push(to: FloatBuffer, v: Vec3): Unit =
    to += v.x
    to += v.y
    to += v.z

  private def triangle(a: Int, b: Int, c: Int): Unit =
    indices += a
    indices += b
    indices += c

  def mesh: Mesh = Mesh(positions.drain(), normals.drain(), uvs.drain(), indices.drain())

private[mitsuba] object TubeBuilder:
  /** Triangles, about. */
  private val Budget = 2e6

  /** The directions of u = 0 and u = 1/4 on Mitsuba's curves. */
  def axes(tangent: Vec3): (Vec3, Vec3) =
    val flat = Vec3.Z - tangent * tangent.z
    val y = if Math.abs(tangent.z) < 1f && flat.lengthSquared > 0f then flat.normalized else Vec3.Y
    (y cross tangent, y)
