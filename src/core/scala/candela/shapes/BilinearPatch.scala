package candela.shapes

import candela.geometry.{Bounds3, Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** A patch of a [[BilinearMesh]], which holds all its data. */
final class BilinearPatch(mesh: BilinearMesh, patch: Int) extends Shape:

  def bounds: Bounds3 = Bounds3.of((0 until 4).map(mesh.vertex(patch, _)))

  def intersect(ray: Ray, hit: Hit): Boolean = mesh.test(patch, ray, hit, write = true)

  def isHit(ray: Ray): Boolean = mesh.test(patch, ray, BilinearPatch.NoHit, write = false)

  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    val u = hit.u.toFloat
    val v = hit.v.toFloat
    val p = BilinearPatch.Corners(mesh, patch)
    at.p = p.point(hit.u, hit.v)
    at.pError = p.error(at.p)
    val pu = p.alongU(v)
    val pv = p.alongV(u)
    val facet = unitNormal(pu, pv)
    val n = shadingNormal(u, v, facet)
    at.geometricNormal = if mesh.normals.length == 0 then facet else facet.facing(n)
    val t = mesh.uvs
    if t.length == 0 then
      at.u = u
      at.v = v
      at.frame.set(Frame.along(n, pu))
      if at.wantsPartials then partials(p, u, v, 1f, 0f, 0f, 1f, at)
    else
      at.u = blend(t, 2, 0, u, v)
      at.v = blend(t, 2, 1, u, v)
      // By the chain rule, with the inverse of ∂(s, t)/∂(u, v)
      val su = alongU(t, 2, 0, v)
      val sv = alongV(t, 2, 0, u)
      val tu = alongU(t, 2, 1, v)
      val tv = alongV(t, 2, 1, u)
      val determinant = differenceOfProducts(su, tv, sv, tu)
      val isSpanned = Math.abs(determinant) > 1e-8f
      val dpds = if isSpanned then (pu * tv - pv * tu) * Math.signum(determinant) else pu
      at.frame.set(Frame.along(n, dpds))
      if at.wantsPartials then
        if isSpanned then
          val inverse = 1f / determinant
          partials(p, u, v, tv * inverse, -tu * inverse, -sv * inverse, su * inverse, at)
        else partials(p, u, v, 1f, 0f, 0f, 1f, at)

  /** Derivatives of point and normal by the texture coordinates s and t; requires the frame. */
  private def partials(
      p: BilinearPatch.Corners,
      u: Float,
      v: Float,
      duds: Float,
      dvds: Float,
      dudt: Float,
      dvdt: Float,
      at: ShadingPoint
  ): Unit =
    val pu = p.alongU(v)
    val pv = p.alongV(u)
    val dpds = pu * duds + pv * dvds
    val dpdt = pu * dudt + pv * dvdt
    val a = mesh.normals
    // The normal before normalisation, and its derivatives
    val isFacet = a.length == 0
    val side = if mesh.flipped then -1f else 1f
    val n = if isFacet then (pu cross pv) * side else triple(blend(a, 3, _, u, v))
    val nu = if isFacet then (pu cross p.twist) * side else triple(alongU(a, 3, _, v))
    val nv = if isFacet then (p.twist cross pv) * side else triple(alongV(a, 3, _, u))
    if n.lengthSquared > 0f then
      val tu = ShadingPoint.turn(n, nu)
      val tv = ShadingPoint.turn(n, nv)
      at.setPartials(dpds, dpdt, tu * duds + tv * dvds, tu * dudt + tv * dvdt)
    else at.setPartials(dpds, dpdt, Vec3.Zero, Vec3.Zero)
    if !isFacet then
      at.tangentU = BilinearPatch.turned(dpds, at.geometricNormal, at.frame.n)
      at.tangentV = BilinearPatch.turned(dpdt, at.geometricNormal, at.frame.n)

  private inline def triple(inline value: Int => Float): Vec3 =
    Vec3(value(0), value(1), value(2))

  private def unitNormal(pu: Vec3, pv: Vec3): Vec3 =
    val n = (pu cross pv).normalized
    if mesh.flipped then -n else n

  private def shadingNormal(u: Float, v: Float, facet: Vec3): Vec3 =
    val n = mesh.normals
    if n.length == 0 then facet
    else
      val blended = Vec3(blend(n, 3, 0, u, v), blend(n, 3, 1, u, v), blend(n, 3, 2, u, v))
      val length2 = blended.lengthSquared
      if length2 > 0f && length2 < Float.PositiveInfinity then blended.normalized else facet

  private inline def value(a: Array[Float], stride: Int, k: Int, corner: Int): Float =
    a(stride * mesh.indices(4 * patch + corner) + k)

  private def blend(a: Array[Float], stride: Int, k: Int, u: Float, v: Float): Float =
    lerp(
      v,
      lerp(u, value(a, stride, k, 0), value(a, stride, k, 1)),
      lerp(u, value(a, stride, k, 2), value(a, stride, k, 3))
    )

  private def alongU(a: Array[Float], stride: Int, k: Int, v: Float): Float =
    lerp(
      v,
      value(a, stride, k, 1) - value(a, stride, k, 0),
      value(a, stride, k, 3) - value(a, stride, k, 2)
    )

  private def alongV(a: Array[Float], stride: Int, k: Int, u: Float): Float =
    lerp(
      u,
      value(a, stride, k, 2) - value(a, stride, k, 0),
      value(a, stride, k, 3) - value(a, stride, k, 1)
    )

  /** ∂p/∂u × ∂p/∂v is affine in u and v, so a cone around the corners' normals contains all
    * normals.
    */
  def normals: (Vec3, Float) =
    val p = BilinearPatch.Corners(mesh, patch)
    val cornerNormals =
      for u <- Seq(0f, 1f); v <- Seq(0f, 1f) yield
        val cross = p.alongU(v) cross p.alongV(u)
        Option.when(!cross.isZero):
          val facet = if mesh.flipped then -cross.normalized else cross.normalized
          if mesh.normals.length == 0 then facet else facet.facing(shadingNormal(u, v, facet))
    val corners = cornerNormals.flatten
    val sum = corners.foldLeft(Vec3.Zero)(_ + _)
    if sum.lengthSquared < 1e-6f then (Vec3.Z, -1f)
    else
      val axis = sum.normalized
      val cosine = corners.map(axis dot _).min
      // A cone wider than a hemisphere is not convex; the margin covers rounding
      if cosine <= 0f then (axis, -1f) else (axis, cosine - 1e-5f)

  private lazy val sampling = BilinearSampling(BilinearPatch.Corners(mesh, patch))

  def area: Float = sampling.area

  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    sampling.sample(u1, u2)(orient = (u, v, facet) =>
      val n = if mesh.flipped then -facet else facet
      if mesh.normals.length == 0 then n else n.facing(shadingNormal(u, v, n)))(out)

  def areaPdf(p: Vec3): Float = sampling.perArea(p)

object BilinearPatch:
  /** Never written to. */
  private val NoHit = Hit()

  /** `v`, rotated as from `from` to `to`: unit vectors that are not opposite. */
  private def turned(v: Vec3, from: Vec3, to: Vec3): Vec3 =
    val sum = from + to
    v - sum * ((sum dot v) / (1f + (from dot to))) + to * (2f * (from dot v))

  /** The corners of a patch and derived quantities; created for hits and samples only. */
  private[shapes] final class Corners(
      val p00: Vec3,
      val p10: Vec3,
      val p01: Vec3,
      val p11: Vec3
  ):
    /** In Double up to the rounding of the result. */
    def point(u: Double, v: Double): Vec3 =
      val w11 = u * v
      val w10 = u - w11
      val w01 = v - w11
      val w00 = 1.0 - u - v + w11
      Vec3(
        (w00 * p00.x + w10 * p10.x + w01 * p01.x + w11 * p11.x).toFloat,
        (w00 * p00.y + w10 * p10.y + w01 * p01.y + w11 * p11.y).toFloat,
        (w00 * p00.z + w10 * p10.z + w01 * p01.z + w11 * p11.z).toFloat
      )

    /** Error bound of a point on the patch. */
    def error(p: Vec3): Vec3 =
      val a = TriangleSoup.error(p, p00, p10, p01)
      val b = TriangleSoup.error(p, p01, p10, p11)
      Vec3(Math.max(a.x, b.x), Math.max(a.y, b.y), Math.max(a.z, b.z))

    /** ∂²p/∂u∂v */
    def twist: Vec3 = (p11 - p01) - (p10 - p00)

    /** ∂p/∂u */
    def alongU(v: Float): Vec3 = (p10 - p00) * (1f - v) + (p11 - p01) * v

    /** ∂p/∂v */
    def alongV(u: Float): Vec3 = (p01 - p00) * (1f - u) + (p11 - p10) * u

  private[shapes] object Corners:
    def apply(mesh: BilinearMesh, patch: Int): Corners = new Corners(
      mesh.vertex(patch, 0),
      mesh.vertex(patch, 1),
      mesh.vertex(patch, 2),
      mesh.vertex(patch, 3)
    )
