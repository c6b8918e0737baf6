package candela.accel.tracing

/** Arrays for diffuse vertices, one number each; [[VertexKernel]] computes most of them.
  *
  * @param most vertices
  */
private[candela] final class DiffuseVertices(most: Int):
  private val size = most + 16
  private def floats() = new Array[Float](size)

  /** Path of each vertex. */
  val who: Array[Int] = new Array[Int](size)
  val triangle: Array[Int] = new Array[Int](size)

  // Triangles: corners, their normals (zero: flat), weights, orientation
  val corner: Array[Array[Float]] = Array.fill(9)(floats())
  val normal: Array[Array[Float]] = Array.fill(9)(floats())
  val u, v, side, length: Array[Double] = new Array[Double](size)

  /** Direction of the ray that came here. */
  val dx, dy, dz: Array[Float] = floats()

  // Point, error, geometric normal, frame, normal for the choice of a light
  val px, py, pz, ex, ey, ez, gx, gy, gz: Array[Float] = floats()
  val nx, ny, nz, sx, sy, sz, tx, ty, tz, lx, ly, lz: Array[Float] = floats()

  /** Local z of the directions that the path comes from, and leaves in. */
  val woZ, wiZ: Array[Float] = floats()

  // Random numbers: choice of light, point on it, direction
  val choice, l1, l2, u1, u2: Array[Float] = floats()

  // Light sample: which, direction, density, shadow ray's origin, end, and fraction
  val light: Array[Int] = new Array[Int](size)
  val probability, lightX, lightY, lightZ, lightPdf: Array[Float] = floats()
  val fromX, fromY, fromZ, endX, endY, endZ, fraction, factor, arrives: Array[Float] = floats()

  // Next ray
  val wx, wy, wz, ox, oy, oz: Array[Float] = floats()
