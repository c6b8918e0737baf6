package candela.geometry

import candela.color.MutableRgb
import candela.math.*

/** A surface interaction: the hit point, with the geometry that textures, materials and lights
  * need.
  *
  * Mutable, one per worker; the shape that was hit fills it once, for the closest hit. Its vectors
  * are stored in place, so a hit allocates nothing; the next hit overwrites them.
  *
  * @param wantsPartials whether shapes compute the partial derivatives, by `setPartials`; the same
  *   for the whole scene
  * @param always whether they do so even where no material reads them
  */
final class ShadingPoint(val wantsPartials: Boolean = false, always: Boolean = false):
  private val ownP, ownPError = MutableVec3()
  private val ownGeometricNormal = MutableVec3(0f, 0f, 1f)
  private val ownDpdu, ownDpdv, ownDndu, ownDndv = MutableVec3()
  private val ownTangentU, ownTangentV, ownDpdx, ownDpdy = MutableVec3()
  private val ownBendU, ownBendV = MutableVec3()

  /** Scratch memory of image textures. */
  private[candela] val texel = MutableRgb()

  /** Scratch memory of triangles. */
  private[candela] val firstEdge, secondEdge = MutableVec3()

  /** In world space. */
  def p: MutableVec3 = ownP
  def p_=(v: Vec3): Unit = ownP.set(v)

  /** Conservative bound of the absolute error of `p`, per component. */
  def pError: MutableVec3 = ownPError
  def pError_=(v: Vec3): Unit = ownPError.set(v)

  /** Geometric unit normal, on the shape's outside. */
  def geometricNormal: MutableVec3 = ownGeometricNormal
  def geometricNormal_=(v: Vec3): Unit = ownGeometricNormal.set(v)

  /** Orthonormal; `frame.n` is the (interpolated) shading normal, in the hemisphere of
    * `geometricNormal`, and `frame.s` follows ∂p/∂u.
    */
  val frame: MutableFrame = MutableFrame()

  /** Surface parameters, for textures. */
  var u, v: Float = 0f

  /** A second set of these, and a colour, of meshes that have them; else of another point. */
  var u2, v2, red, green, blue, alpha: Float = 0f

  /** Partial derivatives of the point and of the normal `frame.n` by `u` and `v`; for meshes with
    * normals, those of the interpolated normal before normalisation.
    */
  def dpdu: MutableVec3 = ownDpdu
  def dpdu_=(v: Vec3): Unit = ownDpdu.set(v)
  def dpdv: MutableVec3 = ownDpdv
  def dpdv_=(v: Vec3): Unit = ownDpdv.set(v)
  def dndu: MutableVec3 = ownDndu
  def dndu_=(v: Vec3): Unit = ownDndu.set(v)
  def dndv: MutableVec3 = ownDndv
  def dndv_=(v: Vec3): Unit = ownDndv.set(v)

  /** Tangents to which displacements are added: `dpdu` and `dpdv`, but tangent to `frame.n` on
    * meshes with interpolated normals.
    */
  def tangentU: MutableVec3 = ownTangentU
  def tangentU_=(v: Vec3): Unit = ownTangentU.set(v)
  def tangentV: MutableVec3 = ownTangentV
  def tangentV_=(v: Vec3): Unit = ownTangentV.set(v)

  /** Derivatives of the normal that displacements are multiplied by: as pbrt transforms them, like
    * normals, hence too short where the transform enlarges, and of the normal before it is flipped.
    */
  def bendU: MutableVec3 = ownBendU
  def bendU_=(v: Vec3): Unit = ownBendU.set(v)
  def bendV: MutableVec3 = ownBendV
  def bendV_=(v: Vec3): Unit = ownBendV.set(v)

  /** Are the tangents for displacements unit vectors along the placed surface, half turned around?
    * Otherwise instances transform them.
    */
  var placesTangents: Boolean = false

  /** 1 if displacements rise along `frame.n`, −1 against it. */
  var bumpSide: Float = 1f

  /** Footprint: change of the point and its parameters from one raster position to the next to the
    * right (x) and below (y), scaled by the camera for the sample density. Zero if unknown or
    * unused: textures are then not filtered.
    */
  def dpdx: MutableVec3 = ownDpdx
  def dpdx_=(v: Vec3): Unit = ownDpdx.set(v)
  def dpdy: MutableVec3 = ownDpdy
  def dpdy_=(v: Vec3): Unit = ownDpdy.set(v)
  var dudx, dvdx, dudy, dvdy: Float = 0f

  /** Does the present hit have partial derivatives, and a footprint? If not, nothing may read them.
    */
  var hasPartials: Boolean = wantsPartials

  /** Are they computed for the present hit even if its material reads neither? */
  var keepsPartials: Boolean = always

  /** A value of this point as if it had no footprint. */
  def withoutFootprint[T](value: ShadingPoint => T): T =
    val (x, y) = (Vec3(dpdx.x, dpdx.y, dpdx.z), Vec3(dpdy.x, dpdy.y, dpdy.z))
    val (ux, vx, uy, vy) = (dudx, dvdx, dudy, dvdy)
    clearFootprint()
    val result = value(this)
    dpdx = x
    dpdy = y
    dudx = ux
    dvdx = vx
    dudy = uy
    dvdy = vy
    result

  /** Begins a hit.
    *
    * @param followed may what is behind the surface need its footprint?
    */
  def startHit(followed: Boolean): Unit =
    hasPartials = wantsPartials
    keepsPartials = always || followed

  def setPartials(dpdu: Vec3, dpdv: Vec3, dndu: Vec3, dndv: Vec3): Unit =
    this.dpdu = dpdu
    this.dpdv = dpdv
    this.dndu = dndu
    this.dndv = dndv
    takeTangents()

  /** Makes displacements follow the partial derivatives, once these are set. */
  private[candela] def takeTangents(): Unit =
    tangentU = dpdu
    tangentV = dpdv
    bendU = dndu
    bendV = dndv
    placesTangents = false
    bumpSide = 1f

  /** Flips the outside. The tangents and the normal's derivatives keep their meaning. */
  def invert(): Unit =
    geometricNormal = -geometricNormal
    frame.set(Frame(frame.s, -frame.t, -frame.n))

  /** Computes the footprint's `dudx` … `dvdy` from `dpdx` and `dpdy`: the least-squares solution of
    * dp = dpdu·du + dpdv·dv.
    */
  def footprintInUv(): Unit =
    val uu = dpdu dot dpdu
    val uv = dpdu dot dpdv
    val vv = dpdv dot dpdv
    val determinant = differenceOfProducts(uu, vv, uv, uv)
    val inverse = if determinant > 0f then 1f / determinant else 0f
    val ux = dpdu dot dpdx
    val vx = dpdv dot dpdx
    val uy = dpdu dot dpdy
    val vy = dpdv dot dpdy
    dudx = ShadingPoint.bounded(differenceOfProducts(vv, ux, uv, vx) * inverse)
    dvdx = ShadingPoint.bounded(differenceOfProducts(uu, vx, uv, ux) * inverse)
    dudy = ShadingPoint.bounded(differenceOfProducts(vv, uy, uv, vy) * inverse)
    dvdy = ShadingPoint.bounded(differenceOfProducts(uu, vy, uv, uy) * inverse)

  /** Marks the footprint as unknown. */
  def clearFootprint(): Unit =
    dpdx = Vec3.Zero
    dpdy = Vec3.Zero
    dudx = 0f
    dvdx = 0f
    dudy = 0f
    dvdy = 0f

  /** Index into the scene's materials. */
  var material: Int = 0

  /** Index into the scene's lights if this surface emits, else −1. */
  var areaLight: Int = -1

  /** Origin of a ray spawned in `direction`, free of self-intersection: offset along the geometric
    * normal out of the box that `pError` spans, then rounded outwards.
    *
    * Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed., §3.9.5.
    */
  def offsetOrigin(direction: Vec3): Vec3 =
    ShadingPoint.offset(p, pError, geometricNormal, direction)

object ShadingPoint:

  /** Derivative of n/|n| for a normal `n` of any length with derivative `dn`. */
  def turn(n: Vec3, dn: Vec3): Vec3 =
    val inverse = 1f / n.length
    val unit = n * inverse
    (dn - unit * (unit dot dn)) * inverse

  def offset(p: Vec3, pError: Vec3, n: Vec3, direction: Vec3): Vec3 =
    val d = Math.abs(n.x) * pError.x + Math.abs(n.y) * pError.y + Math.abs(n.z) * pError.z
    val side = if (direction dot n) < 0f then -d else d
    Vec3(
      offsetAway(p.x, n.x * side),
      offsetAway(p.y, n.y * side),
      offsetAway(p.z, n.z * side)
    )

  /** At grazing incidence a footprint may be arbitrarily large, and even NaN. */
  private def bounded(x: Float): Float =
    if java.lang.Float.isFinite(x) then clamp(x, -1e8f, 1e8f) else 0f

  /** `x` + `by`, and one Float further. By the bits, as no branch could be predicted: the signs of
    * both numbers tell whether the next Float is one up or one down.
    */
  private def offsetAway(x: Float, by: Float): Float =
    val moved = x + by
    val bits = java.lang.Float.floatToRawIntBits(moved)
    val step = (java.lang.Float.floatToRawIntBits(by) ^ bits) >> 31 | 1
    if by == 0f then moved
    else if isOrdinary(moved) then java.lang.Float.intBitsToFloat(bits + step)
    else if by > 0f then Math.nextUp(moved)
    else if by < 0f then Math.nextDown(moved)
    else moved

  /** Neither zero nor infinite nor NaN. */
  private def isOrdinary(x: Float): Boolean =
    ((magnitudeBits(x) - 1) | (Infinity - magnitudeBits(x) - 1)) >= 0

  private inline val Infinity = 0x7f800000
