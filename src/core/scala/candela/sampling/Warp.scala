package candela.sampling

import candela.math.*

/** Sampling functions that map the unit square to common shapes, with their pdfs.
  *
  * `u1` and `u2` are in [0, 1). Directions are unit vectors around +z, their pdfs in sr⁻¹. All
  * results are [[Vec3]] values, which the compiler keeps off the heap: on the disk z is 0, a point
  * of a triangle is its three barycentric weights. The maps are continuous, which preserves the
  * stratification of the square.
  */
object Warp:

  /** Uniform on the disk of radius 1 in the plane z = 0.
    *
    * Source: Shirley & Chiu, "A low distortion map between disk and square", JGT 2(3), 1997.
    */
  def concentricDisk(u1: Float, u2: Float): Vec3 =
    val a = 2f * u1 - 1f
    val b = 2f * u2 - 1f
    // Selected by bits, as a branch could not be predicted: all ones if |a| > |b|
    val wide = (magnitudeBits(b) - magnitudeBits(a)) >> 31
    val r = select(wide, a, b)
    val shorter = select(wide, b, a)
    // The angle to the nearer axis
    val phi = if r == 0f then 0.0 else 0.25 * Math.PI * (shorter / r)
    val along = r * cosOfEighth(phi).toFloat
    val across = r * sinOfEighth(phi).toFloat
    Vec3(select(wide, along, across), select(wide, across, along), 0f)

  /** `a` if all bits of `mask` are ones, `b` if none is. */
  private inline def select(mask: Int, a: Float, b: Float): Float =
    java.lang.Float.intBitsToFloat(
      (java.lang.Float.floatToRawIntBits(a) & mask) | (java.lang.Float.floatToRawIntBits(b) & ~mask)
    )

  /** Cosine-weighted directions with z ≥ 0.
    *
    * Source: Malley's method: PBRT 3rd ed., §13.6.3.
    */
  def cosineHemisphere(u1: Float, u2: Float): Vec3 =
    val d = concentricDisk(u1, u2)
    Vec3(d.x, d.y, safeSqrt(1f - d.x * d.x - d.y * d.y))

  def cosineHemispherePdf(cosTheta: Float): Float = if cosTheta > 0f then cosTheta * InvPi else 0f

  /** Uniform directions with z ≥ 0. Source: PBRT 3rd ed., §13.6.1. */
  def uniformHemisphere(u1: Float, u2: Float): Vec3 =
    spherical(1f - u1, safeSqrt(u1 * (2f - u1)), u2)

  /** Uniform directions. Source: PBRT 3rd ed., §13.6.1. */
  def uniformSphere(u1: Float, u2: Float): Vec3 =
    spherical(1f - 2f * u1, 2f * safeSqrt(u1 * (1f - u1)), u2)

  inline val UniformSpherePdf = 0.07957747154594766788f

  /** Uniform directions within an angle of +z.
    *
    * Source: PBRT 3rd ed., §13.6.4, in 1 − cos θ, which keeps precision for narrow cones.
    *
    * @param oneMinusCosMax 1 − cos of the half-angle, in (0, 2]. From its sine s, for angles up to
    *   90°, best computed as s² / (1 + √(1 − s²)).
    */
  def uniformCone(u1: Float, u2: Float, oneMinusCosMax: Float): Vec3 =
    val h = u1 * oneMinusCosMax
    spherical(1f - h, safeSqrt(h * (2f - h)), u2)

  /** Pdf inside the cone; it is 0 outside. */
  def uniformConePdf(oneMinusCosMax: Float): Float = InvTwoPi / oneMinusCosMax

  /** Uniform on a triangle: the barycentric weights of its corners, which sum to 1.
    *
    * Source: Heitz, "A low-distortion map between triangle and square", 2019.
    */
  def uniformTriangle(u1: Float, u2: Float): Vec3 =
    if u1 < u2 then
      val b0 = u1 * 0.5f
      val b1 = u2 - b0
      Vec3(b0, b1, 1f - b0 - b1)
    else
      val b1 = u2 * 0.5f
      val b0 = u1 - b1
      Vec3(b0, b1, 1f - b0 - b1)

  /** The direction at an angle of θ to +z, and `u` of a turn around it. */
  def spherical(cosTheta: Float, sinTheta: Float, u: Float): Vec3 =
    sinCos(2.0 * Math.PI * u): (sine, cosine) =>
      Vec3(sinTheta * cosine.toFloat, sinTheta * sine.toFloat, cosTheta)
