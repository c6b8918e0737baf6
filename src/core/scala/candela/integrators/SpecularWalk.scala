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
) extends Integrator:
  protected val walk: SurfaceWalk =
    SurfaceWalk(scene, volumes, steps, WalkOptions(interfaces = interfaces))
  protected val connection: LightConnection = walk.connection

  /** Direct light that `vertex`, which is not specular alone, scatters to its `wo`. */
  protected def direct(vertex: SurfaceVertex, sampler: Sampler): Rgb

  /** All light that leaves the vertex, except by specular scattering. */
  protected def gathered(vertex: SurfaceVertex, sampler: Sampler): Rgb =
    if vertex.bsdf.isSpecular then Rgb.Black else direct(vertex, sampler)

  def raysTraced: Long = walk.raysTraced
  override def lastMaterial: Int = walk.vertex.at.material

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    while walk.goesOn do
      val isHit = walk.intersect()
      walk.marchThroughVolumes(sampler)
      if !isHit then walk.addEnvironment()
      else
        val passes = walk.vertex.isInterface
        if !passes || !interfaces.stopsLight then walk.addEmission()
        if passes then walk.passThrough()
        else
          walk.evaluate()
          walk.addScattered(gathered(walk.vertex, sampler))
          if walk.depth == maxDepth then walk.end() else walk.leaveSpecularly(sampler)
    walk.radiance
