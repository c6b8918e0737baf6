package candela.sampling

import candela.math.sinCos

/** Spherical rectangle: samples directions uniformly over the solid angle of a rectangle.
  *
  * The rectangle is [x0, x1] × [y0, y1] at height `z` ≠ 0 over the reference point. Mutable, one
  * per worker: `set` replaces it. Computed in Double, without allocation: the solid angle is a
  * small difference of large angles.
  *
  * Source: Ureña, Fajardo, King, "An Area-Preserving Parametrization for Spherical Rectangles",
  * EGSR 2013.
  */
final class SphericalRectangle:
  private var x0, x1, y0, y1, z = 0.0
  private var area = 0.0
  private var lower, upper = 0.0 // z components of the normals of the planes through y0 and y1
  private var level = 0.0 // squared y component of that through y0
  private var cosRest, sinRest = 0.0 // of 2π less the angles at the corners of x0

  /** The sampled point of the rectangle. */
  var x, y: Double = 0.0

  /** Sets the rectangle; returns its solid angle in sr, 0 to 2π. */
  def set(x0: Double, x1: Double, y0: Double, y1: Double, z: Double): Double =
    this.x0 = x0
    this.x1 = x1
    this.y0 = y0
    this.y1 = y1
    this.z = z
    val toLower = 1 / (z * z + y0 * y0)
    lower = -y0 * Math.sqrt(toLower)
    level = z * z * toLower
    upper = y1 / Math.sqrt(z * z + y1 * y1)
    area = SphericalRectangle.measure(x0, x1, y0, y1, z): (cosine, sine) =>
      val scale = 1 / Math.sqrt(cosine * cosine + sine * sine)
      cosRest = cosine * scale
      sinRest = -sine * scale
    area

  /** Samples a point; requires a positive solid angle. */
  def sample(u1: Float, u2: Float): Unit =
    // The part of the rectangle from x0 to x has the fraction u1 of the solid angle. The source
    // computes rise / run, the x component of a normal, and x from that: this needs fewer divisions
    // and roots
    x = sinCos(u1 * area): (sine, cosine) =>
      val rise = (cosine * cosRest - sine * sinRest) * lower - upper
      val run = sine * cosRest + cosine * sinRest
      val squared = rise * rise - level * run * run
      val across = Math.sqrt(if squared > 1e-300 then squared else 1e-300)
      clamp((if rise < 0 then -run else run) * Math.abs(z) / across, x0, x1)
    // Along the line, uniform in the sine of the elevation
    val d2 = x * x + z * z
    val h0 = y0 / Math.sqrt(d2 + y0 * y0)
    val h1 = y1 / Math.sqrt(d2 + y1 * y1)
    val h = h0 + u2 * (h1 - h0)
    y = clamp(h * Math.sqrt(d2 / Math.max(1e-30, 1 - h * h)), y0, y1)

  // With branches, which are predicted: the JVM's minimum takes as long as a division
  private inline def clamp(v: Double, least: Double, most: Double): Double =
    if v < least then least else if v > most then most else v

object SphericalRectangle:
  /** The solid angle in sr that `set` returns, without preparing to sample the rectangle. */
  def solidAngle(x0: Double, x1: Double, y0: Double, y1: Double, z: Double): Double =
    measure(x0, x1, y0, y1, z)((_, _) => ())

  /** The solid angle is the sum of the angles at the corners, less 2π. An angle is the argument of
    * a complex number, and their sum that of the product: one arctangent instead of four
    * arccosines, and no difference of nearly equal numbers.
    *
    * @param use receives cosine and sine of the sum of the angles at the corners of x0, times a
    *            positive factor
    */
  private inline def measure(x0: Double, x1: Double, y0: Double, y1: Double, z: Double)(
      inline use: (Double, Double) => Unit
  ): Double =
    def height(x: Double, y: Double) = Math.abs(z) * Math.sqrt(x * x + y * y + z * z)
    // No tuples, whose numbers the JVM boxed where it did not inline all of this
    val r0 = x1 * y0
    val i0 = height(x1, y0)
    val r1 = -x1 * y1
    val i1 = height(x1, y1)
    val r2 = x0 * y1
    val i2 = height(x0, y1)
    val r3 = -x0 * y0
    val i3 = height(x0, y0)
    val nearR = r0 * r1 - i0 * i1
    val nearI = r0 * i1 + i0 * r1
    val farR = r2 * r3 - i2 * i3
    val farI = r2 * i3 + i2 * r3
    use(farR, farI)
    val angle = Math.atan2(nearR * farI + nearI * farR, nearR * farR - nearI * farI)
    if angle < 0 then angle + 2 * Math.PI else angle
