package candela.integrators

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** What Whitted's method and direct lighting share: mirrors and glass are followed, and at each
  * other surface on the way the light that comes straight from the sources is gathered.
  *
  * @param maxDepth most specular bounces, plus one
  */
abstract class SpecularWalk(scene: Scene, maxDepth: Int, volumes: VolumeMarch | Null)
    extends LightTransport(scene, volumes):

  /** Light that the sources send to `at` and on to `wo` (world space). */
  protected def direct(bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb

  /** All that leaves `at` towards `wo` and did not come by mirrors or glass. */
  protected def gathered(bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    if bsdf.isSpecular then Rgb.Black else direct(bsdf, wo, sampler)

  /** What is left to do before a camera ray is followed. */
  protected def begin(ray: Ray): Unit = shadowRay.time = ray.time

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    begin(ray)
    val march = volumes
    if march != null then march.start(ray, sampler)
    var light = Rgb.Black
    var throughput = Rgb.White
    var depth = 0
    var alive = true
    while alive do
      rays += 1
      val met = scene.closest(ray, hit)
      if march != null then
        march.march(ray, sampler)
        light += throughput * march.light
        throughput = throughput * march.transmitted
      if !met then
        light += throughput * escaped(ray, (_, _) => 1f)
        alive = false
      else
        scene.surface(ray, hit, at)
        val wo = -ray.direction
        if at.areaLight >= 0 then light += throughput * scene.surfaceLight(at).radiance(at, wo)
        if scene.isInterface(at) then
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
          scene.passed(ray)
        else
          val bsdf = scene.bsdf(at)
          light += throughput * gathered(bsdf, wo, sampler)
          depth += 1
          alive = depth < maxDepth
          if alive then
            val bounce = bsdf.sampleSpecular(at.frame.toLocal(wo), sampler.next1D())
            throughput = throughput * bounce.weight
            alive = !throughput.isBlack
            val wi = at.frame.toWorld(bounce.wi)
            ray.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
            scene.scattered(ray, at, wo, wi, bounce.isSpecular, bounce.eta)
    light
