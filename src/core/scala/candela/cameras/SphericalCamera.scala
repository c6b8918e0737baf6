package candela.cameras

import candela.geometry.Ray
import candela.lights.SphereMap
import candela.math.*

/** Sees all directions from one point; the image centre looks along −x of camera space in the
  * equirectangular mapping, and along +y in the equal-area mapping.
  *
  * @param map   mapping between image and sphere, around the camera's y axis
  * @param folds whether a position past a border maps to the same border, as in octahedral images;
  *   otherwise longitude and latitude simply continue
  * @param step  pixel offset of the differentials; large where the mapping bends
  *
  * Source: PBRT 4th ed., §5.3; for the border Clarberg 2008, as [[candela.lights.EqualAreaMap]].
  */
final class SphericalCamera(
    cameraToWorld: Transform,
    frame: FilmFrame,
    map: SphereMap,
    folds: Boolean,
    override val step: Float = 0.05f
) extends Camera:
  private val eye = cameraToWorld.point(Vec3.Zero)

  override def hasLens: Boolean = false

  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
    val u = x / frame.width
    val v = y / frame.height
    val d =
      if folds then
        // Folds over a vertical border, then a horizontal one: each reflects the other coordinate
        val isBeside = u < 0f || u > 1f
        val v1 = if isBeside then 1f - v else v
        val isBeyond = v1 < 0f || v1 > 1f
        val u1 = mirrored(u)
        map.toDirection(if isBeyond then 1f - u1 else u1, mirrored(v1))
      else map.toDirection(u, v)
    ray.set(eye, cameraToWorld.vector(Vec3(d.x, d.z, d.y)).normalized, Float.PositiveInfinity)

  private def mirrored(t: Float): Float = if t < 0f then -t else if t > 1f then 2f - t else t
