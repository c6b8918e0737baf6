package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.sampling.Sampler
import candela.scene.Scene

/** What Whitted's algorithm and direct lighting share: paths follow specular reflection and
  * transmission, and gather direct light at every vertex.
  *
  * @param maxDepth specular bounces plus one, at most
  * @param steps    as in [[SurfaceWalk]]
  * @param interfaces what they are to light sampling; unless they are open, emitters without a BSDF
  *                   are invisible
  */
abstract class SpecularWalk(
    scene: Scene,
    maxDepth: Int,
    volumes: VolumeMarch | Null,
    steps: Float = VolumeMarch.StepsToLights,
    interfaces: Interfaces = Interfaces.Open
) extends SurfaceWalk(scene, volumes, steps, interfaces):

  /** Direct light that `vertex`, which is not specular alone, scatters to its `wo`. */
  protected def direct(vertex: SurfaceVertex, sampler: Sampler): Rgb

  /** All light that leaves the vertex, except by specular scattering. */
  protected def gathered(vertex: SurfaceVertex, sampler: Sampler): Rgb =
    if vertex.bsdf.isSpecular then Rgb.Black else direct(vertex, sampler)

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    startPath(cameraRay, sampler)
    while goesOn do
      val isHit = intersect()
      marchThroughVolumes(sampler)
      if !isHit then addEnvironment()
      else
        val passes = vertex.isInterface
        if !passes || !interfaces.stopsLight then addEmission()
        if passes then passThrough()
        else
          evaluate()
          addScattered(gathered(vertex, sampler))
          if path.depth == maxDepth then end() else leaveSpecularly(sampler)
    L.toRgb
