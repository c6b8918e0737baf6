package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Recursive ray tracing: every light is sampled once at each point, and mirrors and glass are
  * followed.
  *
  * @param maxDepth most specular bounces, plus one
  *
  * Source: Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980; one
  * random specular branch instead of a tree, as in [[DirectLighting]].
  */
final class Whitted(scene: Scene, maxDepth: Int) extends LightTransport(scene):

  def copy(): Whitted = Whitted(scene, maxDepth)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    var light = Rgb.Black
    var throughput = Rgb.White
    var depth = 0
    var alive = true
    while alive do
      rays += 1
      if !scene.closest(ray, hit) then
        light += throughput * escaped(ray.direction, (_, _) => 1f)
        alive = false
      else
        scene.surface(ray, hit, at)
        val wo = -ray.direction
        if at.areaLight >= 0 then light += throughput * scene.surfaceLight(at).radiance(at, wo)
        if scene.isInterface(at) then
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
        else
          val bsdf = scene.bsdf(at)
          if !bsdf.isSpecular then
            var i = 0
            while i < scene.lights.length do
              sampler.next2D()
              light += throughput * sampleLight(i, 1f, bsdf, wo, sampler, combined = false)
              i += 1
          depth += 1
          alive = depth < maxDepth
          if alive then
            val bounce = bsdf.sampleSpecular(at.frame.toLocal(wo), sampler.next1D())
            throughput = throughput * bounce.weight
            alive = !throughput.isBlack
            val wi = at.frame.toWorld(bounce.wi)
            ray.set(at.offsetOrigin(wi), wi, Float.PositiveInfinity)
    light
