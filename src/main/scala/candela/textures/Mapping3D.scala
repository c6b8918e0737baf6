package candela.textures

import candela.geometry.ShadingPoint
import candela.math.*

/** Takes a point to its place in a solid texture.
  *
  * @param worldToTexture in pbrt-v2 and v3 it is the statement's transform itself, in v4 its
  *                       inverse
  */
final class Mapping3D(worldToTexture: Transform):
  def apply(at: ShadingPoint): Vec3 = worldToTexture.point(at.p)

  /** Squared, the longer of the two steps to neighbouring places on the film. */
  def footprintSquared(at: ShadingPoint): Float =
    Math.max(
      worldToTexture.vector(at.dpdx).lengthSquared,
      worldToTexture.vector(at.dpdy).lengthSquared
    )

  /** For each axis, how far the place moves at most to its neighbours on the film. */
  def extent(at: ShadingPoint): Vec3 =
    val x = worldToTexture.vector(at.dpdx)
    val y = worldToTexture.vector(at.dpdy)
    Vec3(
      Math.max(abs(x.x), abs(y.x)),
      Math.max(abs(x.y), abs(y.y)),
      Math.max(abs(x.z), abs(y.z))
    )
