package candela.integrators

import candela.color.Rgb
import candela.sampling.Sampler
import candela.scene.Scene

/** Recursive ray tracing: samples every light once at each vertex, and follows specular reflection
  * and transmission.
  *
  * @param maxDepth   specular bounces plus one, at most
  * @param interfaces as in [[SpecularWalk]]
  *
  * Source: Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980; one
  * random specular branch instead of a tree, as in [[DirectLighting]].
  */
final class Whitted(
    scene: Scene,
    maxDepth: Int,
    volumes: VolumeMarch | Null = null,
    interfaces: Interfaces = Interfaces.Open
) extends SpecularWalk(scene, maxDepth, volumes, steps = 1f, interfaces):

  protected def direct(vertex: SurfaceVertex, sampler: Sampler): Rgb =
    var sum = Rgb.Black
    var i = 0
    while i < scene.lights.length do
      sampler.next2D()
      connection.choose(i)
      if connection.samplePoint(vertex.point.p, sampler.x, sampler.y) then
        sum += connection.scattered(vertex, weight = _ => 1f)
      i += 1
    sum
