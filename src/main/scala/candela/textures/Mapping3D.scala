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
