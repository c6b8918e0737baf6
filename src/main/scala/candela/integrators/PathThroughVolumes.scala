package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Path tracing where volumes fill boxes, as pbrt-v2 has it: the camera's ray gathers what they
  * emit and scatter, and all other ways of light are dimmed by them.
  *
  * @param maxDepth, rouletteAfter, rouletteThreshold as in [[PathTracer]]
  */
final class PathThroughVolumes(
    scene: Scene,
    march: VolumeMarch,
    maxDepth: Int,
    rouletteAfter: Int,
    rouletteThreshold: Float
) extends LightTransport(scene, march):

  protected def over(scene: Scene): PathThroughVolumes =
    PathThroughVolumes(scene, march.copy(), maxDepth, rouletteAfter, rouletteThreshold)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    shadowRay.time = ray.time
    march.start(ray, sampler)
    var light = Rgb.Black
    var throughput = Rgb.White
    var depth = 0
    var etaScale = 1f
    var lastPdf = 0f // of the direction just sampled; 0: no light sample competed with it
    var alive = true
    while alive do
      rays += 1
      val met = scene.closest(ray, hit)
      if depth == 0 then
        march.march(ray, sampler)
        light += throughput * march.light
        throughput = throughput * march.transmitted
      else throughput = throughput * march.dimming(ray, stepsToLights)
      if !met then
        light += throughput * escaped(ray, lastPdf)
        alive = false
      else
        scene.surface(ray, hit, at)
        val wo = -ray.direction
        light += metLight(throughput, wo, lastPdf)
        if scene.isInterface(at) then
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
          scene.passed(ray)
          lastPdf = 0f // shadow rays end here
        else if depth == maxDepth then alive = false
        else
          depth += 1
          val bsdf = scene.bsdf(at)
          val choice = sampler.next1D()
          sampler.next2D()
          if !bsdf.isSpecular && scene.lights.length > 0 then
            light += throughput * oneLight(choice, bsdf, wo, sampler)
          draw(bsdf, at.frame.toLocal(wo), sampler)
          throughput = throughput * bounce.weight
          lastPdf = if bounce.isSpecular then 0f else bounce.pdf
          keepPlace()
          etaScale *= square(bounce.eta)
          val wi = at.frame.toWorld(bounce.wi)
          ray.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
          scene.scattered(ray, at, wo, wi, bounce.isSpecular, bounce.eta)
          alive = !throughput.isBlack && (bounce.isSpecular || isOpenSide(wi, wo, bsdf))
          if alive && depth > rouletteAfter then
            throughput = throughput *
              LightTransport.roulette(throughput, etaScale, rouletteThreshold, sampler)
            alive = !throughput.isBlack
    light
