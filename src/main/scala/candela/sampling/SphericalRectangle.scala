package candela.sampling

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
  private var rest = 0.0

  /** The sampled point of the rectangle. */
  var x, y: Double = 0.0

  /** Sets the rectangle; returns its solid angle in sr, 0 to 2π. */
  def set(x0: Double, x1: Double, y0: Double, y1: Double, z: Double): Double =
    this.x0 = x0
    this.x1 = x1
    this.y0 = y0
    this.y1 = y1
    this.z = z
    SphericalRectangle.measure(x0, x1, y0, y1, z): (solidAngle, farther, below, above) =>
      area = solidAngle
      rest = 2 * Math.PI - farther
      lower = below
      upper = above
    area

  /** Samples a point; requires a positive solid angle. */
  def sample(u1: Float, u2: Float): Unit =
    // The part of the rectangle from x0 to x has the fraction u1 of the solid angle
    val part = u1 * area + rest
    val slope = (Math.cos(part) * lower - upper) / Math.sin(part)
    val c = clamp(Math.signum(slope) / Math.sqrt(slope * slope + lower * lower), -1, 1)
    val depth = Math.abs(z)
    x = clamp(c * depth / Math.sqrt(Math.max(1e-30, 1 - c * c)), x0, x1)
    // Along the line, uniform in the sine of the elevation
    val d2 = x * x + z * z
    val h0 = y0 / Math.sqrt(d2 + y0 * y0)
    val h1 = y1 / Math.sqrt(d2 + y1 * y1)
    val h = h0 + u2 * (h1 - h0)
    y = clamp(h * Math.sqrt(d2 / Math.max(1e-30, 1 - h * h)), y0, y1)

  private def clamp(v: Double, least: Double, most: Double): Double =
    Math.max(least, Math.min(most, v))

object SphericalRectangle:
  /** The solid angle in sr that `set` returns, without preparing to sample the rectangle. */
  def solidAngle(x0: Double, x1: Double, y0: Double, y1: Double, z: Double): Double =
    measure(x0, x1, y0, y1, z)((solidAngle, _, _, _) => solidAngle)

  /** @param use receives the solid angle, the sum of the angles at the corners of x0, and the z
    *            components of the normals of the planes through the edges at y0 and y1
    */
  private inline def measure[A](x0: Double, x1: Double, y0: Double, y1: Double, z: Double)(
      inline use: (Double, Double, Double, Double) => A
  ): A =
    val z2 = z * z
    val below = -y0 / Math.sqrt(z2 + y0 * y0)
    val right = x1 / Math.sqrt(z2 + x1 * x1)
    val above = y1 / Math.sqrt(z2 + y1 * y1)
    val left = -x0 / Math.sqrt(z2 + x0 * x0)
    val farther = Math.acos(-above * left) + Math.acos(-left * below)
    val nearer = Math.acos(-below * right) + Math.acos(-right * above)
    use(farther + nearer - 2 * Math.PI, farther, below, above)
