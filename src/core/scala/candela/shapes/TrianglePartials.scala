package candela.shapes

import candela.geometry.{Frame, ShadingPoint}
import candela.math.*

/** Partial derivatives of point and normal over a triangle. */
private[shapes] object TrianglePartials:

  /** Sets the partial derivatives at a point; requires its frame.
    *
    * A triangle with degenerate u and v gets arbitrary unit tangents. If a mesh has normals, the
    * tangents for displacements follow them.
    *
    * @param e1, e2 edges from the first corner to the second and to the third
    * @param relief whether these tangents are needed
    */
  def fill(
      mesh: Mesh,
      i0: Int,
      i1: Int,
      i2: Int,
      e1: Vec3,
      e2: Vec3,
      relief: Boolean,
      at: ShadingPoint
  ): Unit =
    val k0 = i0 - mesh.firstVertex
    val k1 = i1 - mesh.firstVertex
    val k2 = i2 - mesh.firstVertex
    val t = mesh.uvs
    // Differences of the parameters along the two edges; the default uv are (0,0), (1,0), (1,1)
    val isPlain = t.length == 0
    val j0 = mesh.uvAt(i0)
    val j1 = mesh.uvAt(i1)
    val j2 = mesh.uvAt(i2)
    val u1 = if isPlain then 1f else t(j1) - t(j0)
    val v1 = if isPlain then 0f else t(j1 + 1) - t(j0 + 1)
    val u2 = if isPlain then 1f else t(j2) - t(j0)
    val v2 = if isPlain then 1f else t(j2 + 1) - t(j0 + 1)
    val determinant = differenceOfProducts(u1, v2, u2, v1)
    val isDegenerate = Math.abs(determinant) < Degenerate
    val n = mesh.normals
    if isDegenerate then
      val frame = Frame.fromZ(at.geometricNormal)
      at.setPartials(frame.s, frame.t, Vec3.Zero, Vec3.Zero)
    else
      val inverse = 1f / determinant
      at.dpdu = (e1 * v2 - e2 * v1) * inverse
      at.dpdv = (e2 * u1 - e1 * u2) * inverse
      if n.length == 0 then
        at.dndu = Vec3.Zero
        at.dndv = Vec3.Zero
      else
        // Derivative of the interpolated normal before normalisation, as in pbrt
        val n0 = normal(n, k0)
        val d1 = normal(n, k1) - n0
        val d2 = normal(n, k2) - n0
        at.dndu = (d1 * v2 - d2 * v1) * inverse
        at.dndv = (d2 * u1 - d1 * u2) * inverse
      at.takeTangents()
    if relief && n.length > 0 then tangents(at, mesh.bumps)

  private def tangents(at: ShadingPoint, bumps: BumpTangents): Unit =
    val ns = at.frame.n
    if bumps.within == null then
      val along = Frame.along(ns, at.dpdu)
      if bumps.turned then
        at.tangentU = -along.s
        at.tangentV = -along.t
      else
        val length = (ns cross at.dpdu).length
        at.tangentU = along.s * length
        at.tangentV = along.t * length
    else
      val objectU = bumps.toObject.vector(at.dpdu)
      val n = bumps.toObject.normal(ns).normalized
      val along = Frame.along(n, objectU)
      val scale = if bumps.turned then -1f else (n cross objectU).length
      at.tangentU = bumps.within.vector(along.s * scale)
      at.tangentV = bumps.within.vector(along.t * scale)
    at.placesTangents = bumps.placed
    if bumps.bendsBack then
      at.bendU = -at.bendU
      at.bendV = -at.bendV
    if bumps.sinks then at.bumpSide = -1f

  private def normal(n: Array[Float], vertex: Int): Vec3 =
    Vec3(n(3 * vertex), n(3 * vertex + 1), n(3 * vertex + 2))

  /** Threshold of the determinant of u and v, as in pbrt. */
  private val Degenerate = 1e-8f

/** How displacements see a mesh with normals: the tangents along which they are differentiated
  * (pbrt-v4's are as long as the surface's own), and the side to which they rise.
  *
  * @param turned    unit tangents, rotated by 180 degrees: bumps of u and v become dents (v3, v2)
  * @param sinks     whether they rise against the normal (pbrt-v2's meshes of reversed orientation)
  * @param bendsBack whether the normals were flipped, but not their derivatives (pbrt-v3's meshes
  *                  of reversed orientation)
  * @param placed    whether instances leave them unit vectors (pbrt-v2)
  * @param within    the space in which the tangents were found, if the mesh was transformed since:
  *                  pbrt-v3 and v4 transform them with the instance
  */
final case class BumpTangents(
    turned: Boolean,
    sinks: Boolean = false,
    bendsBack: Boolean = false,
    placed: Boolean = false,
    within: Transform | Null = null
):
  private[shapes] val toObject: Transform =
    if within == null then Transform.Identity else within.inverse

object BumpTangents:
  /** Those of pbrt-v4. */
  val Along: BumpTangents = BumpTangents(turned = false)

  /** Those of pbrt-v3. */
  val Turned: BumpTangents = BumpTangents(turned = true)

  /** Those of pbrt-v2. */
  def ofV2(isReversed: Boolean): BumpTangents =
    BumpTangents(turned = true, sinks = isReversed, placed = true)
