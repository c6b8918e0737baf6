package candela.geometry

import candela.math.*

/** Ray differential: the offset rays of the next raster position to the right (x) and below (y).
  * Their distance at a surface determines the filter footprint of textures.
  *
  * Source: Igehy, "Tracing Ray Differentials", SIGGRAPH 1999.
  */
final class RayDifferential:
  /** Whether the offset rays are valid; false after non-specular scattering. */
  var isKnown = false

  private val ownXOrigin, ownXDirection, ownYOrigin, ownYDirection = MutableVec3()

  def xOrigin: MutableVec3 = ownXOrigin
  def xOrigin_=(v: Vec3): Unit = ownXOrigin.set(v)
  def xDirection: MutableVec3 = ownXDirection
  def xDirection_=(v: Vec3): Unit = ownXDirection.set(v)
  def yOrigin: MutableVec3 = ownYOrigin
  def yOrigin_=(v: Vec3): Unit = ownYOrigin.set(v)
  def yDirection: MutableVec3 = ownYDirection
  def yDirection_=(v: Vec3): Unit = ownYDirection.set(v)

  def copy(from: RayDifferential): Unit =
    isKnown = from.isKnown
    xOrigin = from.xOrigin
    xDirection = from.xDirection
    yOrigin = from.yOrigin
    yDirection = from.yDirection

  /** Sets `at.dpdx` and `at.dpdy` from the intersections of the offset rays with the tangent plane.
    *
    * @return false, leaving both unset, if the offset rays miss the plane
    */
  def computeFootprint(at: ShadingPoint): Boolean =
    val n = at.geometricNormal
    val tx = ((at.p - xOrigin) dot n) / (xDirection dot n)
    val ty = ((at.p - yOrigin) dot n) / (yDirection dot n)
    val isHit = isKnown && java.lang.Float.isFinite(tx) && java.lang.Float.isFinite(ty)
    if isHit then
      at.dpdx = xOrigin + xDirection * tx - at.p
      at.dpdy = yOrigin + yDirection * ty - at.p
    isHit

  /** Reflects the offset rays, which hit the plane at `at`.
    *
    * @param wo unit vector towards the ray's origin
    * @param wi reflected direction
    */
  def reflect(at: ShadingPoint, wo: Vec3, wi: Vec3): Unit =
    val n = at.frame.n
    val cosine = wo dot n
    def direction(previous: Vec3, dn: Vec3): Vec3 =
      val dwo = -previous - wo
      val dCosine = (dwo dot n) + (wo dot dn)
      wi - dwo + (dn * cosine + n * dCosine) * 2f
    xDirection = direction(xDirection, dndx(at))
    yDirection = direction(yDirection, dndy(at))
    setOrigins(at)

  /** Refracts the offset rays at a smooth interface.
    *
    * @param eta index of refraction on the side of `wi` over that of `wo`
    */
  def refract(at: ShadingPoint, wo: Vec3, wi: Vec3, eta: Float): Unit =
    val side = if (wo dot at.frame.n) < 0f then -1f else 1f
    val n = at.frame.n * side
    val cosine = wo dot n
    val inside = wi absDot n
    val ratio = 1f / eta
    // Snell's law is wi = −ratio·wo + mu·n; its derivative by the product rule
    val mu = ratio * cosine - inside
    def direction(previous: Vec3, dn: Vec3): Vec3 =
      val dwo = -previous - wo
      val dCosine = (dwo dot n) + (wo dot dn)
      val dMu = (ratio - ratio * ratio * cosine / inside) * dCosine
      wi - dwo * ratio + dn * mu + n * dMu
    xDirection = direction(xDirection, dndx(at) * side)
    yDirection = direction(yDirection, dndy(at) * side)
    setOrigins(at)

  private def setOrigins(at: ShadingPoint): Unit =
    xOrigin = at.p + at.dpdx
    yOrigin = at.p + at.dpdy
    isKnown = isSane(xOrigin) && isSane(yOrigin) && isSane(xDirection) && isSane(yDirection)

  private def isSane(v: Vec3): Boolean = v.lengthSquared < RayDifferential.Largest

  private def dndx(at: ShadingPoint): Vec3 = at.dndu * at.dudx + at.dndv * at.dvdx
  private def dndy(at: ShadingPoint): Vec3 = at.dndu * at.dudy + at.dndv * at.dvdy

object RayDifferential:
  /** Squared limit; larger differences are dominated by rounding and grazing incidence. */
  private val Largest = 1e16f
