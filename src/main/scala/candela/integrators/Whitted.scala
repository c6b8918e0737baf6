package candela.integrators

import candela.bsdf.Bsdf
import candela.color.Rgb
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
final class Whitted(scene: Scene, maxDepth: Int, volumes: VolumeMarch | Null = null)
    extends SpecularWalk(scene, maxDepth, volumes):

  protected def over(scene: Scene): Whitted = Whitted(scene, maxDepth, VolumeMarch.copy(volumes))

  override protected def stepsToLights: Float = 1f

  protected def direct(bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    var sum = Rgb.Black
    var i = 0
    while i < scene.lights.length do
      sampler.next2D()
      sum += sampleLight(i, 1f, bsdf, wo, sampler, combined = false)
      i += 1
    sum
