package candela.sampling

import candela.math.*

/** Spherical triangle: samples directions uniformly over the solid angle of a triangle.
  *
  * Mutable, one per worker: `set` replaces the triangle. Computed in Double, without allocation:
  * the areas are small differences of large angles.
  *
  * Sources: Arvo, "Stratified sampling of spherical triangles", SIGGRAPH 1995; the area by Van
  * Oosterom & Strackee, "The solid angle of a plane triangle", IEEE Trans. Biomed. Eng. 30(2),
  * 1983.
  */
final class SphericalTriangle:

  // Unit directions to the corners
  private var ax, ay, az, bx, by, bz, cx, cy, cz = 0.0
  private var cosAB = 0.0
  private var sinAlpha, cosAlpha = 0.0 // of the angle at a
  private var area = 0.0

  /** Sets the triangle `p0`, `p1`, `p2`, seen from `from`; returns its solid angle in sr, 0 to 2π;
    * NaN if `from` is at a corner.
    */
  def set(from: Vec3, p0: Vec3, p1: Vec3, p2: Vec3): Double =
    ax = p0.x.toDouble - from.x
    ay = p0.y.toDouble - from.y
    az = p0.z.toDouble - from.z
    val a = 1 / length(ax, ay, az)
    ax *= a
    ay *= a
    az *= a
    bx = p1.x.toDouble - from.x
    by = p1.y.toDouble - from.y
    bz = p1.z.toDouble - from.z
    val b = 1 / length(bx, by, bz)
    bx *= b
    by *= b
    bz *= b
    cx = p2.x.toDouble - from.x
    cy = p2.y.toDouble - from.y
    cz = p2.z.toDouble - from.z
    val c = 1 / length(cx, cy, cz)
    cx *= c
    cy *= c
    cz *= c
    cosAB = ax * bx + ay * by + az * bz
    // The angle at a is the one between the planes through (a, b) and (a, c).
    val abX = ay * bz - az * by
    val abY = az * bx - ax * bz
    val abZ = ax * by - ay * bx
    val acX = ay * cz - az * cy
    val acY = az * cx - ax * cz
    val acZ = ax * cy - ay * cx
    val scale = 1 / (length(abX, abY, abZ) * length(acX, acY, acZ))
    val triple = Math.abs(abX * cx + abY * cy + abZ * cz)
    sinAlpha = triple * scale
    cosAlpha = (abX * acX + abY * acY + abZ * acZ) * scale
    area = 2 * Math.atan2(
      triple,
      1 + cosAB + (bx * cx + by * cy + bz * cz) + (cx * ax + cy * ay + cz * az)
    )
    area

  private val direction = MutableVec3()

  /** Samples a unit direction; requires a positive solid angle. */
  def sample(u1: Float, u2: Float): MutableVec3 =
    // Moves the corner c along its arc until the remaining part has the fraction u1 of the area.
    val subArea = u1 * area
    var s, t = 0.0
    sinCos(subArea): (sine, cosine) =>
      s = sine * cosAlpha - cosine * sinAlpha
      t = cosine * cosAlpha + sine * sinAlpha
    val u = t - cosAlpha
    val v = s + sinAlpha * cosAB
    val q = clamped(((v * t - u * s) * cosAlpha - v) / ((v * s + u * t) * sinAlpha))
    val cosAC = ax * cx + ay * cy + az * cz
    val ex = cx - ax * cosAC
    val ey = cy - ay * cosAC
    val ez = cz - az * cosAC
    val eScale = sine(q) / positive(length(ex, ey, ez))
    val mx = ax * q + ex * eScale
    val my = ay * q + ey * eScale
    val mz = az * q + ez * eScale
    // Then samples the arc from b to the moved corner, uniformly in the height over b.
    val cosBM = bx * mx + by * my + bz * mz
    val w = 1 - u2 * (1 - cosBM)
    val fx = mx - bx * cosBM
    val fy = my - by * cosBM
    val fz = mz - bz * cosBM
    val fScale = sine(w) / positive(length(fx, fy, fz))
    direction.set(
      Vec3(
        (bx * w + fx * fScale).toFloat,
        (by * w + fy * fScale).toFloat,
        (bz * w + fz * fScale).toFloat
      )
    )
    direction

  private def length(x: Double, y: Double, z: Double): Double = Math.sqrt(x * x + y * y + z * z)
  private def clamped(x: Double): Double = Math.max(-1.0, Math.min(1.0, x))
  private def sine(cosine: Double): Double = Math.sqrt(Math.max(0.0, 1 - cosine * cosine))
  private def positive(x: Double): Double = if x > 0 then x else 1.0

object SphericalTriangle:

  /** The solid angle in sr that `set` returns, without preparing to sample the triangle. */
  def solidAngle(from: Vec3, p0: Vec3, p1: Vec3, p2: Vec3): Double =
    val ax = p0.x.toDouble - from.x
    val ay = p0.y.toDouble - from.y
    val az = p0.z.toDouble - from.z
    val bx = p1.x.toDouble - from.x
    val by = p1.y.toDouble - from.y
    val bz = p1.z.toDouble - from.z
    val cx = p2.x.toDouble - from.x
    val cy = p2.y.toDouble - from.y
    val cz = p2.z.toDouble - from.z
    val a = Math.sqrt(ax * ax + ay * ay + az * az)
    val b = Math.sqrt(bx * bx + by * by + bz * bz)
    val c = Math.sqrt(cx * cx + cy * cy + cz * cz)
    val triple = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    val ab = ax * bx + ay * by + az * bz
    val bc = bx * cx + by * cy + bz * cz
    val ca = cx * ax + cy * ay + cz * az
    2 * Math.atan2(Math.abs(triple), a * b * c + ab * c + bc * a + ca * b)
