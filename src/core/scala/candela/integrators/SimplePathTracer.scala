package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.sampling.Sampler
import candela.scene.Scene

/** How [[SimplePathTracer]] continues a path: in a direction sampled from the BSDF, or in any
  * direction with equal density, of those that the BSDF scatters to or of all.
  */
enum Onward:
  case Bsdf, Hemisphere, Sphere

/** Path tracing without multiple importance sampling or Russian roulette: each kind of light is
  * found in one way only.
  *
  * @param maxDepth      scattering events of a path, at most
  * @param samplesLights does light sampling find all light but that seen directly or by way of
  *                      specular surfaces? Else paths find light only where they hit it
  * @param crosses       do paths continue through interfaces? Each counts as a scattering event
  *
  * Source: PBRT 4th ed., §13.1.2 and §13.2.
  */
final class SimplePathTracer(
    scene: Scene,
    maxDepth: Int,
    samplesLights: Boolean,
    onward: Onward,
    crosses: Boolean = true
) extends CameraPathIntegrator:
  protected val walk: SurfaceWalk = SurfaceWalk(
    scene,
    options = WalkOptions(
      samplesLights = samplesLights,
      interfaces = Interfaces.Closed,
      countsPassed = true
    )
  )

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    while walk.goesOn do
      val isHit = walk.intersect()
      val isSampled = walk.path.competes
      if isHit then
        if !isSampled then walk.addEmission()
        if walk.vertex.isInterface then
          if crosses then walk.passThrough(maxDepth) else walk.end()
        else if walk.hasHad(maxDepth) then walk.end()
        else
          walk.evaluate()
          if walk.sampleLight(sampler) then walk.connectBy(weight = _ => 1f)
          onward match
            case Onward.Bsdf => walk.scatter(sampler)
            case Onward.Hemisphere =>
              walk.scatterUniformly(walk.vertex.bsdf.isTransmissive, sampler)
            case Onward.Sphere => walk.scatterUniformly(bothSides = true, sampler)
          walk.leave()
      else if isSampled then walk.end()
      else walk.addEnvironment()
    walk.radiance
