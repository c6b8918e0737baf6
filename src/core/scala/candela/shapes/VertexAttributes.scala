package candela.shapes

import candela.geometry.ShadingPoint
import candela.math.*

/** What vertices of a mesh have beside positions, normals and u and v; each may be empty.
  *
  * @param uvs      a second set of u and v
  * @param colors   four Floats each: red, green, blue and alpha
  * @param tangents four Floats each: the tangent of the space of normal maps, and 1 or −1, the sign
  *                 of the other tangent
  */
final class VertexAttributes(
    val uvs: Array[Float],
    val colors: Array[Float],
    val tangents: Array[Float]
):
  def isEmpty: Boolean = uvs.isEmpty && colors.isEmpty && tangents.isEmpty

  /** With tangents in world space. */
  def placed(toWorld: Transform): VertexAttributes =
    if toWorld.isIdentity || tangents.isEmpty then this
    else
      val sign = if toWorld.swapsHandedness then -1f else 1f
      val moved = new Array[Float](tangents.length)
      var i = 0
      while i < moved.length do
        val t = toWorld.vector(Vec3(tangents(i), tangents(i + 1), tangents(i + 2)))
        moved(i) = t.x
        moved(i + 1) = t.y
        moved(i + 2) = t.z
        moved(i + 3) = tangents(i + 3) * sign
        i += 4
      VertexAttributes(uvs, colors, moved)

  /** Interpolates between the vertices `k0`, `k1` and `k2`. */
  private[shapes] def fill(
      k0: Int,
      k1: Int,
      k2: Int,
      b1: Float,
      b2: Float,
      at: ShadingPoint
  ): Unit =
    val b0 = 1f - b1 - b2
    def mean(values: Array[Float], each: Int, c: Int) =
      b0 * values(each * k0 + c) + b1 * values(each * k1 + c) + b2 * values(each * k2 + c)
    if uvs.length > 0 then
      at.u2 = mean(uvs, 2, 0)
      at.v2 = mean(uvs, 2, 1)
    if colors.length > 0 then
      at.red = mean(colors, 4, 0)
      at.green = mean(colors, 4, 1)
      at.blue = mean(colors, 4, 2)
      at.alpha = mean(colors, 4, 3)

  /** The interpolated tangent; zero without any. */
  private[shapes] def tangent(k0: Int, k1: Int, k2: Int, b1: Float, b2: Float): Vec3 =
    if tangents.length == 0 then Vec3.Zero
    else
      val b0 = 1f - b1 - b2
      def mean(c: Int) =
        b0 * tangents(4 * k0 + c) + b1 * tangents(4 * k1 + c) + b2 * tangents(4 * k2 + c)
      Vec3(mean(0), mean(1), mean(2))

  /** The side of the other tangent. */
  private[shapes] def sign(vertex: Int): Float = tangents(4 * vertex + 3)

object VertexAttributes:
  val Empty: VertexAttributes =
    VertexAttributes(Array.emptyFloatArray, Array.emptyFloatArray, Array.emptyFloatArray)
