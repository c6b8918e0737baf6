package candela.build.shapes

import candela.base.loop
import scala.collection.mutable.ArrayBuffer

import candela.math.Transform
import candela.shapes.{BumpTangents, Mesh, TriangleSoup, VertexIndices}

/** Collects the meshes of a scene, in world space, for one [[TriangleSoup]]. */
final class SoupBuilder:
  private val positions = ArrayBuffer.empty[Array[Float]]

  /** Of each mesh, with the number of its first vertex. */
  private val indices = ArrayBuffer.empty[(Array[Int], Int)]

  private val meshes = ArrayBuffer.empty[Mesh]
  private var vertices = 0
  private var triangles = 0

  def triangleCount: Int = triangles

  /** Adds a mesh and returns the index of its first triangle.
    *
    * @param flipNormals whether to flip the given shading normals (pbrt-v4 does for
    *                    ReverseOrientation)
    * @param isTurned    whether the geometric normals are turned over once more
    * @param firstLight  index of its first triangle's light; −1: it does not emit
    * @param paired      does a light consist of two triangles each?
    * @param readsPartials may its material or light read partial derivatives or footprints?
    * @param facesFacet, turned as in [[Mesh]]
    */
  def add(
      mesh: ShapeGeometry.Triangles,
      toWorld: Transform,
      reversed: Boolean,
      flipNormals: Boolean,
      isTurned: Boolean,
      material: Int,
      firstLight: Int,
      bumps: BumpTangents,
      paired: Boolean = false,
      readsPartials: Boolean = true,
      facesFacet: Boolean = false,
      turned: Boolean = false
  ): Int =
    val first = triangles
    val base = vertices
    positions += SoupBuilder.points(mesh.positions, toWorld)
    indices += ((mesh.indices, base))
    meshes += Mesh(
      firstVertex = base,
      firstTriangle = first,
      triangles = mesh.indices.length / 3,
      normals = SoupBuilder.normals(mesh.normals, toWorld, reversed && flipNormals),
      uvs = SoupBuilder.compact(mesh.uvs),
      flipped = (reversed != toWorld.swapsHandedness) != isTurned,
      material = material,
      firstLight = firstLight,
      bumps = bumps,
      paired = paired,
      readsPartials = readsPartials,
      facesFacet = facesFacet,
      turned = turned,
      content = mesh.content.map(c => s"$c ${toWorld.m.mkString(" ")}"),
      attributes = mesh.attributes.placed(toWorld)
    )
    vertices += mesh.positions.length / 3
    triangles += mesh.indices.length / 3
    first

  /** Returns the meshes and releases the builder's arrays, to save memory.
    *
    * @param tangents, relief as in [[TriangleSoup]]
    */
  def result(tangents: Boolean, relief: Boolean): TriangleSoup =
    val points =
      if positions.length == 1 then positions.head else Array.concat(positions.toSeq*)
    positions.clear()
    val corners = VertexIndices.joined(indices.iterator, 3 * triangles)
    indices.clear()
    new TriangleSoup(points, corners, meshes.toArray, tangents, relief)

object SoupBuilder:
  /** One pair alone if all are the same: many programs write uv of meshes that have none. */
  private def compact(uvs: Array[Float]): Array[Float] =
    def bits(i: Int) = java.lang.Float.floatToRawIntBits(uvs(i))
    var i = 2
    while i < uvs.length && bits(i) == bits(i & 1) do i += 1
    if uvs.length > 2 && i == uvs.length then uvs.take(2) else uvs

  private[build] def points(p: Array[Float], toWorld: Transform): Array[Float] =
    if toWorld.isIdentity then p
    else
      val m = toWorld.m
      val transformed = new Array[Float](p.length)
      loop(p.length / 3): i =>
        val x = p(3 * i).toDouble
        val y = p(3 * i + 1).toDouble
        val z = p(3 * i + 2).toDouble
        val w = m(12) * x + m(13) * y + m(14) * z + m(15)
        loop(3): r =>
          transformed(3 * i + r) =
            ((m(4 * r) * x + m(4 * r + 1) * y + m(4 * r + 2) * z + m(4 * r + 3)) / w).toFloat
      transformed

  private[build] def normals(n: Array[Float], toWorld: Transform, flip: Boolean): Array[Float] =
    if n.length == 0 || (toWorld.isIdentity && !flip) then n
    else if toWorld.isFlat then Array.empty // a flattened mesh has its own normals
    else
      val m = toWorld.inverseM
      val sign = if flip then -1.0 else 1.0
      val transformed = new Array[Float](n.length)
      loop(n.length / 3): i =>
        val x = n(3 * i) * sign
        val y = n(3 * i + 1) * sign
        val z = n(3 * i + 2) * sign
        // Not normalised: lengths weight the interpolation, as in pbrt
        transformed(3 * i) = (m(0) * x + m(4) * y + m(8) * z).toFloat
        transformed(3 * i + 1) = (m(1) * x + m(5) * y + m(9) * z).toFloat
        transformed(3 * i + 2) = (m(2) * x + m(6) * y + m(10) * z).toFloat
      transformed
