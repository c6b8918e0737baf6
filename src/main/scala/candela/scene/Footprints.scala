package candela.scene

import candela.cameras.PixelCone
import candela.geometry.{Ray, ShadingPoint}
import candela.math.Vec3

/** Which part of a texture a sample stands for, along a path.
  *
  * @param followsSpecular do differentials go on past mirrors and glass? Else they end there
  * @param otherwise       the footprint of rays that have none; if empty, textures show their
  *                        finest detail to them
  */
final class Footprints(followsSpecular: Boolean, otherwise: Option[PixelCone]):
  private val cone: PixelCone | Null = otherwise.orNull

  /** Fills in the footprint of the point that the ray has met. */
  def find(ray: Ray, at: ShadingPoint): Unit =
    val rays = ray.differential
    if rays.isKnown && rays.meet(at) then at.footprintInUv()
    else
      val approximate = cone
      if approximate != null then
        approximate.meet(at)
        at.footprintInUv()
      else at.clearFootprint()

  /** The ray goes on from `at` to `wi`, having come from `wo` (world space). */
  def scattered(
      ray: Ray,
      at: ShadingPoint,
      wo: Vec3,
      wi: Vec3,
      isSpecular: Boolean,
      eta: Float
  ): Unit =
    val rays = ray.differential
    if rays.isKnown then
      if !isSpecular || !followsSpecular then rays.isKnown = false
      else if ((wo dot at.frame.n) < 0f) == ((wi dot at.frame.n) < 0f) then rays.reflect(at, wo, wi)
      else rays.refract(at, wo, wi, eta)

  /** The ray goes straight on through an interface: as after any other scattering in pbrt-v2 and
    * v3, while v4 keeps its differential.
    */
  def passed(ray: Ray): Unit = if cone == null then ray.differential.isKnown = false
