package candela.shapes

import candela.base.loop
import candela.geometry.{Bounds3, Frame, Hit, ShadingPoint}
import candela.math.*

/** A mesh of the soup: its ranges of vertices and triangles, and its appearance.
  *
  * @param firstVertex   index of its first vertex in [[TriangleSoup.positions]], in vertices
  * @param firstTriangle index of its first triangle
  * @param normals       three Floats per vertex, world space, any length; empty for flat shading
  * @param uvs           two Floats per vertex, or two that all vertices have; if empty, (0,0),
  *   (1,0), (1,1) in every triangle
  * @param flipped       whether the geometric normal is −(p1−p0)×(p2−p0)
  * @param material      index into the scene's materials
  * @param firstLight    light of its first triangle, the others follow; −1 if it does not emit
  * @param bumps         tangents for displacements, if it has normals
  * @param paired        does a light consist of two triangles each?
  * @param readsPartials may its material or light read partial derivatives or footprints?
  * @param facesFacet    whether its geometric normals follow the corners alone, not `normals`
  * @param turned        whether its shading tangent is −∂p/∂u, if it has normals
  * @param attributes    what else its vertices have
  */
final class Mesh(
    val firstVertex: Int,
    val firstTriangle: Int,
    val triangles: Int,
    val normals: Array[Float],
    val uvs: Array[Float],
    val flipped: Boolean,
    val material: Int,
    val firstLight: Int,
    val bumps: BumpTangents = BumpTangents.Along,
    val paired: Boolean = false,
    val readsPartials: Boolean = true,
    val facesFacet: Boolean = false,
    val turned: Boolean = false,
    val content: Option[String] = None,
    attributes: VertexAttributes = VertexAttributes.Empty
):
  private[shapes] val extras: VertexAttributes | Null =
    if attributes.isEmpty then null else attributes

  /** Where the u of a vertex of the soup is in `uvs`, unless these are empty. */
  private[shapes] def uvAt(vertex: Int): Int =
    if uvs.length == 2 then 0 else (vertex - firstVertex) * 2

/** All triangles of a scene in world space.
  *
  * @param positions x, y, z of every vertex of every mesh
  * @param indices   three vertices per triangle, numbered over all meshes
  * @param meshes    in the order of their triangles
  * @param tangents  whether any material needs the direction of u; it is not computed otherwise
  * @param relief    the same of the tangents to which displacements are added
  */
final class TriangleSoup(
    val positions: Array[Float],
    val indices: VertexIndices,
    val meshes: Array[Mesh],
    tangents: Boolean,
    relief: Boolean = true
):
  def count: Int = indices.length / 3

  private val ends = meshes.map(m => m.firstTriangle + m.triangles)

  /** The mesh of one triangle in [[TriangleSoup.Marked]]; empty if there is only one mesh. */
  private val marks = if meshes.length < 2 then Array.emptyIntArray else marked

  private def marked: Array[Int] =
    val result = new Array[Int]((count + TriangleSoup.Marked - 1) / TriangleSoup.Marked)
    var mesh = 0
    loop(result.length): i =>
      while i * TriangleSoup.Marked >= ends(mesh) do mesh += 1
      result(i) = mesh
    result

  def meshOf(triangle: Int): Int =
    if marks.length == 0 then 0
    else
      var mesh = marks(triangle / TriangleSoup.Marked)
      while triangle >= ends(mesh) do mesh += 1
      mesh

  def vertex(triangle: Int, corner: Int): Vec3 =
    val i = indices(3 * triangle + corner) * 3
    Vec3(positions(i), positions(i + 1), positions(i + 2))

  def bounds(triangle: Int): Bounds3 =
    Bounds3.of(Seq(vertex(triangle, 0), vertex(triangle, 1), vertex(triangle, 2)))

  /** Computes the geometry of the point with barycentric weights (1−hit.u−hit.v, hit.u, hit.v).
    *
    * The weights sum to one in Double, so the point lies in the triangle's plane up to the final
    * rounding to Float, which `pError` bounds (stability suite: self-intersection).
    */
  def surface(triangle: Int, hit: Hit, at: ShadingPoint): Unit =
    val mesh = meshes(meshOf(triangle))
    val i0 = indices(3 * triangle)
    val i1 = indices(3 * triangle + 1)
    val i2 = indices(3 * triangle + 2)
    val b1 = hit.u.toFloat
    val b2 = hit.v.toFloat
    setPoint(3 * i0, 3 * i1, 3 * i2, hit.u, hit.v, at)
    facet(3 * i0, 3 * i1, 3 * i2, if mesh.flipped then -1.0 else 1.0, at)
    val n = at.frame.n
    n.set(at.geometricNormal)
    if mesh.normals.length > 0 then
      shadingNormal(mesh, i0, i1, i2, b1, b2, n)
      if !mesh.facesFacet && (at.geometricNormal dot n) < 0f then
        at.geometricNormal = -at.geometricNormal
    uv(mesh, i0, i1, i2, b1, b2, at)
    val extras = mesh.extras
    if extras != null then
      val first = mesh.firstVertex
      extras.fill(i0 - first, i1 - first, i2 - first, b1, b2, at)
    at.hasPartials = at.wantsPartials && (mesh.readsPartials || at.keepsPartials)
    if !tangents && !at.hasPartials then at.frame.alignToNormal()
    else
      val p0 = vertex(triangle, 0)
      val e1 = at.firstEdge
      val e2 = at.secondEdge
      e1.set(vertex(triangle, 1) - p0)
      e2.set(vertex(triangle, 2) - p0)
      val stored = storedTangent(mesh, i0, i1, i2, b1, b2)
      if tangents then
        val along = if stored.isZero then dpdu(mesh, i0, i1, i2, e1, e2) else stored
        val isTurned = mesh.turned && mesh.normals.length > 0
        at.frame.set(Frame.along(n, if isTurned then -along else along))
      else at.frame.alignToNormal()
      if at.hasPartials then
        TrianglePartials.fill(mesh, i0, i1, i2, e1, e2, relief, at)
        if !stored.isZero then
          at.tangentU = stored
          at.tangentV = (n cross stored) * mesh.extras.nn.sign(i0 - mesh.firstVertex)
    at.material = mesh.material
    at.areaLight =
      if mesh.firstLight < 0 then -1
      else
        val i = triangle - mesh.firstTriangle
        mesh.firstLight + (if mesh.paired then i >> 1 else i)

  /** The tangent that the vertices have; zero without any. */
  private def storedTangent(mesh: Mesh, i0: Int, i1: Int, i2: Int, b1: Float, b2: Float): Vec3 =
    val extras = mesh.extras
    if extras == null then Vec3.Zero
    else
      val first = mesh.firstVertex
      extras.tangent(i0 - first, i1 - first, i2 - first, b1, b2)

  /** Computes the point and its error bound; `j0` … are the offsets of the corners' coordinates.
    */
  private def setPoint(j0: Int, j1: Int, j2: Int, b1: Double, b2: Double, at: ShadingPoint): Unit =
    val b0 = 1.0 - b1 - b2
    val p = positions
    val x = (b0 * p(j0) + b1 * p(j1) + b2 * p(j2)).toFloat
    val y = (b0 * p(j0 + 1) + b1 * p(j1 + 1) + b2 * p(j2 + 1)).toFloat
    val z = (b0 * p(j0 + 2) + b1 * p(j1 + 2) + b2 * p(j2 + 2)).toFloat
    at.p = Vec3(x, y, z)
    at.pError = Vec3(
      TriangleSoup.error(x, p(j0), p(j1), p(j2)),
      TriangleSoup.error(y, p(j0 + 1), p(j1 + 1), p(j2 + 1)),
      TriangleSoup.error(z, p(j0 + 2), p(j1 + 2), p(j2 + 2))
    )

  /** Sets the geometric unit normal, times `side`; any normal perpendicular to the longer side if
    * the triangle has no area.
    */
  private def facet(j0: Int, j1: Int, j2: Int, side: Double, at: ShadingPoint): Unit =
    val p = positions
    val ax = p(j1).toDouble - p(j0)
    val ay = p(j1 + 1).toDouble - p(j0 + 1)
    val az = p(j1 + 2).toDouble - p(j0 + 2)
    val bx = p(j2).toDouble - p(j0)
    val by = p(j2 + 1).toDouble - p(j0 + 1)
    val bz = p(j2 + 2).toDouble - p(j0 + 2)
    val x = ay * bz - az * by
    val y = az * bx - ax * bz
    val z = ax * by - ay * bx
    val length = Math.sqrt(x * x + y * y + z * z)
    if length > 0.0 then
      val s = side / length
      at.geometricNormal = Vec3((x * s).toFloat, (y * s).toFloat, (z * s).toFloat)
    else
      val isFirst = ax == 0.0 && ay == 0.0 && az == 0.0
      val along =
        if isFirst then Vec3(bx.toFloat, by.toFloat, bz.toFloat)
        else Vec3(ax.toFloat, ay.toFloat, az.toFloat)
      at.geometricNormal =
        if along.isZero then Vec3.Z else Frame.fromZ(along.normalized).s * side.toFloat

  /** Sets `n` to the interpolated normal, normalised; leaves it unchanged if the corners' normals
    * cancel.
    */
  private def shadingNormal(
      mesh: Mesh,
      i0: Int,
      i1: Int,
      i2: Int,
      b1: Float,
      b2: Float,
      out: MutableVec3
  ): Unit =
    val n = mesh.normals
    val b0 = 1f - b1 - b2
    val j0 = (i0 - mesh.firstVertex) * 3
    val j1 = (i1 - mesh.firstVertex) * 3
    val j2 = (i2 - mesh.firstVertex) * 3
    val sum = Vec3(
      b0 * n(j0) + b1 * n(j1) + b2 * n(j2),
      b0 * n(j0 + 1) + b1 * n(j1 + 1) + b2 * n(j2 + 1),
      b0 * n(j0 + 2) + b1 * n(j1 + 2) + b2 * n(j2 + 2)
    )
    val length2 = sum.lengthSquared
    if length2 > 0f && length2 < Float.PositiveInfinity then out.set(sum * (1f / sqrt(length2)))

  /** Products of the normals at the vertices with `n`; zero if those don't orient the triangle. */
  def vertexCosines(triangle: Int, n: Vec3): Vec3 =
    val mesh = meshes(meshOf(triangle))
    def cosine(corner: Int) =
      val j = (indices(3 * triangle + corner) - mesh.firstVertex) * 3
      Vec3(mesh.normals(j), mesh.normals(j + 1), mesh.normals(j + 2)) dot n
    if mesh.normals.length == 0 || mesh.facesFacet then Vec3.Zero
    else Vec3(cosine(0), cosine(1), cosine(2))

  private def uv(
      mesh: Mesh,
      i0: Int,
      i1: Int,
      i2: Int,
      b1: Float,
      b2: Float,
      at: ShadingPoint
  ): Unit =
    val t = mesh.uvs
    if t.length == 0 then
      at.u = b1 + b2
      at.v = b2
    else
      val b0 = 1f - b1 - b2
      val j0 = mesh.uvAt(i0)
      val j1 = mesh.uvAt(i1)
      val j2 = mesh.uvAt(i2)
      at.u = b0 * t(j0) + b1 * t(j1) + b2 * t(j2)
      at.v = b0 * t(j0 + 1) + b1 * t(j1 + 1) + b2 * t(j2 + 1)

  /** ∂p/∂u up to a positive factor; any edge if the parameterisation is degenerate. */
  private def dpdu(mesh: Mesh, i0: Int, i1: Int, i2: Int, e1: Vec3, e2: Vec3): Vec3 =
    val t = mesh.uvs
    if t.length == 0 then e1
    else
      val j0 = mesh.uvAt(i0)
      val j1 = mesh.uvAt(i1)
      val j2 = mesh.uvAt(i2)
      val v1 = t(j1 + 1) - t(j0 + 1)
      val v2 = t(j2 + 1) - t(j0 + 1)
      val determinant = differenceOfProducts(t(j1) - t(j0), v2, t(j2) - t(j0), v1)
      if determinant == 0f then e1
      else (e1 * v2 - e2 * v1) * Math.signum(determinant)

object TriangleSoup:
  def apply(
      positions: Array[Float],
      indices: Array[Int],
      meshes: Array[Mesh],
      tangents: Boolean,
      relief: Boolean = true
  ): TriangleSoup =
    new TriangleSoup(positions, VertexIndices(indices), meshes, tangents, relief)

  /** Triangles from one whose mesh is noted to the next. */
  private inline val Marked = 16

  /** Rounding a Double point to Float costs half an ulp; one more for its use. */
  def roundingError(p: Vec3): Vec3 =
    Vec3(roundingError(p.x), roundingError(p.y), roundingError(p.z))

  /** Of one coordinate. */
  private[shapes] def roundingError(x: Float): Float = Math.abs(x) * gamma(2)

  /** Rounding error of Double coordinates: it matters for points of a large triangle close to the
    * origin.
    */
  private inline val DoubleError = 2e-15f

  /** Error bound of a point that is a mean of the corners. */
  private[shapes] def error(p: Vec3, p0: Vec3, p1: Vec3, p2: Vec3): Vec3 = Vec3(
    error(p.x, p0.x, p1.x, p2.x),
    error(p.y, p0.y, p1.y, p2.y),
    error(p.z, p0.z, p1.z, p2.z)
  )

  private def error(x: Float, a: Float, b: Float, c: Float): Float =
    // By the bits: the JVM's maximum of Floats takes several times as long
    val largest = Math.max(magnitudeBits(a), Math.max(magnitudeBits(b), magnitudeBits(c)))
    Math.abs(x) * gamma(2) + java.lang.Float.intBitsToFloat(largest) * DoubleError
