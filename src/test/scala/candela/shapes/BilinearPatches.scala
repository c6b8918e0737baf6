package candela.shapes

import candela.math.*
import candela.testing.Draws

/** Bilinear patches to test with. */
object BilinearPatches:
  /** The corners of the unit square in the order of [[BilinearMesh]], moved by up to a third. */
  def corners(draws: Draws): Seq[Vec3] =
    for v <- Seq(0f, 1f); u <- Seq(0f, 1f) yield Vec3(u, v, 0f) + draws.vec(-0.33f, 0.33f)

  def flat(points: Seq[Vec3]): Array[Float] = points.flatMap(p => Seq(p.x, p.y, p.z)).toArray

  def of(points: Seq[Vec3], flipped: Boolean = false): BilinearPatch =
    BilinearPatch(
      BilinearMesh(flat(points), Array(0, 1, 2, 3), Array.empty, Array.empty, flipped),
      0
    )

  def random(
      draws: Draws,
      toWorld: Transform,
      normals: Boolean,
      uvs: Boolean,
      flipped: Boolean
  ): BilinearMesh =
    def wobbly() = Vec3(0f, 0f, 1f) + draws.vec(-0.3f, 0.3f)
    val n = Seq.fill(4)(toWorld.normal(wobbly()).normalized * draws.between(0.5f, 2f))
    val turned = Seq(0.1f, 0f, 0.8f, 0.7f, -0.6f, 0.9f, 0.2f, 1.7f)
    BilinearMesh(
      flat(corners(draws).map(toWorld.point)),
      Array(0, 1, 2, 3),
      if normals then flat(n) else Array.empty,
      if uvs then turned.toArray else Array.empty,
      flipped
    )
