package candela.scene

import candela.cameras.PixelCone
import candela.geometry.{Ray, ShadingPoint}
import candela.math.Vec3

/** Texture footprints of path vertices: ray differentials where available, else an approximation.
  *
  * @param followsSpecular if true, differentials continue through specular scattering; else they
  *   end at the first hit
  * @param otherwise       footprint of rays without differentials; if empty, textures are not
  *   filtered for them
  */
final class Footprints(followsSpecular: Boolean, otherwise: Option[PixelCone]):
  private val cone: PixelCone | Null = otherwise.orNull

  /** Sets the footprint of the hit point `at`. */
  def setFootprint(ray: Ray, at: ShadingPoint): Unit =
    val rays = ray.differential
    if rays.isKnown && rays.computeFootprint(at) then at.footprintInUv()
    else
      val approximate = cone
      if approximate != null then
        approximate.approximateFootprint(at)
        at.footprintInUv()
      else at.clearFootprint()

  /** Updates the differential of a ray scattered at `at` from `wo` to `wi` (world space). */
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

  /** Updates the differential of a ray that passes an interface unscattered: pbrt-v2 and v3 treat
    * it as any other scattering event; v4 keeps the differential.
    */
  def passed(ray: Ray): Unit = if cone == null then ray.differential.isKnown = false
