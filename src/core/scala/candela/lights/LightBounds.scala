package candela.lights

import candela.base.loop
import candela.concurrency.Parallel
import candela.geometry.Bounds3
import candela.math.*

/** Spatial and directional bounds of the emission of one or more lights, to estimate their
  * contribution to a point.
  *
  * @param axis         mean direction of the surface normals (unit)
  * @param cosNormals   cosine of the largest angle between a normal and `axis` (θo)
  * @param cosEmission  cosine of the largest angle between a normal and emitted light (θe)
  * @param power        emitted power, in a unit common to all lights
  *
  * Source: Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
  * Splitting", PACMCGIT 1(2), 2018; the bound for cones as in Pharr, Jakob, Humphreys, "Physically
  * Based Rendering", 4th ed., §12.6.3.
  */
final case class LightBounds(
    box: Bounds3,
    axis: Vec3,
    cosNormals: Float,
    cosEmission: Float,
    power: Float,
    twoSided: Boolean
):
  def union(b: LightBounds): LightBounds =
    if power == 0f then b
    else if b.power == 0f then this
    else
      val (sum, cosSum) = LightBounds.unionCones(axis, cosNormals, b.axis, b.cosNormals)
      LightBounds(
        box.union(b.box),
        sum,
        cosSum,
        Math.min(cosEmission, b.cosEmission),
        power + b.power,
        twoSided || b.twoSided
      )

object LightBounds:
  def everywhere(p: Vec3, power: Float): LightBounds =
    LightBounds(Bounds3(p, p), Vec3.Z, -1f, 0f, power, twoSided = false)

  /** Smallest cone around two cones, as axis and cosine of the half-angle. */
  private def unionCones(a: Vec3, cosA: Float, b: Vec3, cosB: Float): (Vec3, Float) =
    // All directions contain any other: the usual case of spheres
    if cosA == -1f then (a, cosA) else unionNarrow(a, cosA, b, cosB)

  private def unionNarrow(a: Vec3, cosA: Float, b: Vec3, cosB: Float): (Vec3, Float) =
    val angleA = Math.acos(clamp(cosA, -1f, 1f).toDouble)
    val angleB = Math.acos(clamp(cosB, -1f, 1f).toDouble)
    val angle = Math.acos(clamp(a dot b, -1f, 1f).toDouble)
    if Math.min(angle + angleB, Math.PI) <= angleA then (a, cosA)
    else if Math.min(angle + angleA, Math.PI) <= angleB then (b, cosB)
    else
      val halfAngle = (angleA + angle + angleB) / 2
      val turnAxis = a cross b
      if halfAngle >= Math.PI || turnAxis.isZero then (Vec3.Z, -1f)
      else
        val turned = Transform
          .rotate(Math.toDegrees(halfAngle - angleA), turnAxis.x, turnAxis.y, turnAxis.z)
          .fold(a)(_.vector(a))
        (turned.normalized, Math.cos(halfAngle).toFloat)

/** [[LightBounds]] in a flat array, for light sampling. Immutable. */
final class LightNodes(bounds: Array[LightBounds | Null], pool: Parallel = Parallel.Alone):
  import LightNodes.*

  private val data = new Array[Float](Stride * bounds.length)
  pool.ranges(bounds.length): (from, until) =>
    loop(until - from): i =>
      val b = bounds(from + i)
      if b != null then write(Stride * (from + i), b)

  private def write(at: Int, b: LightBounds): Unit =
    val center = b.box.center
    val radius2 = square(b.box.radius)
    data(at) = center.x
    data(at + 1) = center.y
    data(at + 2) = center.z
    data(at + 3) = b.axis.x
    data(at + 4) = b.axis.y
    data(at + 5) = b.axis.z
    data(at + 6) = safeSqrt(1f - square(b.cosNormals))
    data(at + 7) = b.cosNormals
    data(at + 8) = radius2
    data(at + 9) = Math.max(radius2, square(b.box.extent.length * 0.5f))
    data(at + 10) = b.power
    data(at + 11) = b.cosEmission
    data(at + 12) = if b.twoSided then 1f else 0f

  /** Estimate of the contribution of the lights with this index to `p` with normal `n` (zero
    * vector: a point that receives light from all directions). Zero only if they can't contribute.
    */
  def importance(node: Int, p: Vec3, n: Vec3): Float =
    val offset = Stride * node
    val x = data(offset) - p.x
    val y = data(offset + 1) - p.y
    val z = data(offset + 2) - p.z
    val distance2 = x * x + y * y + z * z
    val isApart = distance2 > 0f
    val inverse = if isApart then 1f / sqrt(distance2) else 0f
    val wx = x * inverse
    val wy = y * inverse
    val wz = if isApart then z * inverse else 1f
    val cosAxis0 = -(data(offset + 3) * wx + data(offset + 4) * wy + data(offset + 5) * wz)
    val cosAxis = if data(offset + 12) != 0f then Math.abs(cosAxis0) else cosAxis0
    val sinAxis = safeSqrt(1f - square(cosAxis))
    // θb: half the angle subtended by the bounding sphere; all directions from inside
    val radius2 = data(offset + 8)
    val cosBox = if distance2 < radius2 then -1f else safeSqrt(1f - radius2 / distance2)
    val sinBox = safeSqrt(1f - square(cosBox))
    val sinNormals = data(offset + 6)
    val cosNormals = data(offset + 7)
    val cosX = cosDifference(sinAxis, cosAxis, sinNormals, cosNormals)
    val sinX = sinDifference(sinAxis, cosAxis, sinNormals, cosNormals)
    val cosMin = cosDifference(sinX, cosX, sinBox, cosBox)
    if cosMin <= data(offset + 11) then 0f
    else
      val emitted = data(offset + 10) * cosMin / Math.max(distance2, data(offset + 9))
      if n.isZero then emitted
      else
        val cosSurface = wx * n.x + wy * n.y + wz * n.z
        val sinSurface = safeSqrt(1f - square(cosSurface))
        emitted * inFront(cosDifference(sinSurface, cosSurface, sinBox, cosBox))

private object LightNodes:
  inline val Stride = 16

  /** `v` in front, a fiftieth of |v| behind: shading normals don't tell exactly which light a
    * surface receives.
    */
  inline def inFront(v: Float): Float = 0.51f * Math.abs(v) + 0.49f * v

  /** cos(max(0, a − b)); `sinDifference` is sin(max(0, a − b)). */
  inline def cosDifference(sinA: Float, cosA: Float, sinB: Float, cosB: Float): Float =
    if cosA > cosB then 1f else cosA * cosB + sinA * sinB
  inline def sinDifference(sinA: Float, cosA: Float, sinB: Float, cosB: Float): Float =
    if cosA > cosB then 0f else sinA * cosB - cosA * sinB
