package candela.math

/** Interpolates between two affine maps: translation, rotation and stretch separately, the rotation
  * at constant speed. Constant before `startTime` and after `endTime`.
  *
  * Maps that swap handedness are treated as a rotation and a stretch with three negative factors,
  * so that nothing turns inside out in between.
  *
  * Source: Shoemake and Duff, "Matrix Animation and Polar Decomposition", Graphics Interface 1992;
  * Shoemake, "Animating Rotation with Quaternion Curves", SIGGRAPH 1985.
  *
  * @param origin   centre of rotation: translations are relative to it
  * @param shortest whether to rotate by the smaller of the two angles; if false (pbrt-v2), by the
  *   signs of the quaternions
  */
final class Interpolation(
    start: Transform,
    end: Transform,
    startTime: Float,
    endTime: Float,
    shortest: Boolean,
    origin: Vec3 = Vec3.Zero
) extends Motion:
  private val a = PolarDecomposition(start)
  private val b0 = PolarDecomposition(end)
  private val cos0 = a.dot(b0)
  // Nearly opposite quaternions are the same rotation, and can't be interpolated
  private val b =
    if cos0 < -Interpolation.MaxCosine || (shortest && cos0 < 0) then b0.reversed else b0
  private val cosAngle = a.dot(b)
  private val angle = Math.acos(Math.min(1.0, cosAngle))
  private val sinAngle = Math.sin(angle)

  /** The angle between quaternions is half that of the rotations. */
  def rotationRate(leastAngle: Double): Double =
    if endTime > startTime then Math.max(2 * angle, leastAngle) / (endTime - startTime) else 0

  private val startPlace = Interpolation.of(start, origin)
  private val endPlace = Interpolation.of(end, origin)

  def write(time: Float, to: Array[Double], at: Int): Unit =
    if !(time > startTime) then Motion.writeRows(start, to, at)
    else if time >= endTime then Motion.writeRows(end, to, at)
    else interpolate((time.toDouble - startTime) / (endTime.toDouble - startTime), to, at)

  private def interpolate(t: Double, to: Array[Double], at: Int): Unit =
    val isNear = cosAngle > Interpolation.MaxCosine
    val wa = if isNear then 1 - t else Math.sin((1 - t) * angle) / sinAngle
    val wb = if isNear then t else Math.sin(t * angle) / sinAngle
    val qx = wa * a.x + wb * b.x
    val qy = wa * a.y + wb * b.y
    val qz = wa * a.z + wb * b.z
    val qw = wa * a.w + wb * b.w
    val s = 2 / (qx * qx + qy * qy + qz * qz + qw * qw)
    val r00 = 1 - s * (qy * qy + qz * qz)
    val r01 = s * (qx * qy - qz * qw)
    val r02 = s * (qx * qz + qy * qw)
    val r10 = s * (qx * qy + qz * qw)
    val r11 = 1 - s * (qx * qx + qz * qz)
    val r12 = s * (qy * qz - qx * qw)
    val r20 = s * (qx * qz - qy * qw)
    val r21 = s * (qy * qz + qx * qw)
    val r22 = 1 - s * (qx * qx + qy * qy)
    var c = 0
    while c < 3 do
      val s0 = (1 - t) * a.stretch(c) + t * b.stretch(c)
      val s1 = (1 - t) * a.stretch(3 + c) + t * b.stretch(3 + c)
      val s2 = (1 - t) * a.stretch(6 + c) + t * b.stretch(6 + c)
      to(at + c) = r00 * s0 + r01 * s1 + r02 * s2
      to(at + 4 + c) = r10 * s0 + r11 * s1 + r12 * s2
      to(at + 8 + c) = r20 * s0 + r21 * s1 + r22 * s2
      c += 1
    var r = 0
    while r < 3 do
      val k = at + 4 * r
      val turned = to(k) * origin.x + to(k + 1) * origin.y + to(k + 2) * origin.z
      to(k + 3) = (1 - t) * startPlace(r) + t * endPlace(r) - turned
      r += 1
    Interpolation.invert(to, at, at + 12)

object Interpolation:
  /** At larger cosines of half the angle, its sine is too small to divide by; pbrt's value. */
  private val MaxCosine = 0.9995

  /** The image of a point. */
  private def of(t: Transform, p: Vec3): Array[Double] =
    Array.tabulate(3): r =>
      t.m(4 * r) * p.x + t.m(4 * r + 1) * p.y + t.m(4 * r + 2) * p.z + t.m(4 * r + 3)

  /** The inverse of the affine map in the 12 numbers from `from` on. */
  private def invert(m: Array[Double], from: Int, at: Int): Unit =
    def cofactor(r0: Int, c0: Int, r1: Int, c1: Int) =
      m(from + 4 * r0 + c0) * m(from + 4 * r1 + c1) - m(from + 4 * r0 + c1) * m(from + 4 * r1 + c0)
    val c00 = cofactor(1, 1, 2, 2)
    val c01 = cofactor(1, 2, 2, 0)
    val c02 = cofactor(1, 0, 2, 1)
    val scale = 1 / (m(from) * c00 + m(from + 1) * c01 + m(from + 2) * c02)
    m(at) = c00 * scale
    m(at + 1) = cofactor(2, 1, 0, 2) * scale
    m(at + 2) = cofactor(0, 1, 1, 2) * scale
    m(at + 4) = c01 * scale
    m(at + 5) = cofactor(2, 2, 0, 0) * scale
    m(at + 6) = cofactor(0, 2, 1, 0) * scale
    m(at + 8) = c02 * scale
    m(at + 9) = cofactor(2, 0, 0, 1) * scale
    m(at + 10) = cofactor(0, 0, 1, 1) * scale
    var r = at
    while r < at + 12 do
      m(r + 3) = -(m(r) * m(from + 3) + m(r + 1) * m(from + 7) + m(r + 2) * m(from + 11))
      r += 4
