package candela.integrators

import candela.aov.LightParts
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
) extends SurfaceWalk(scene, interfaces = Interfaces.Closed):
  override def lightParts: LightParts | Null = extension.lightParts

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    startPath(cameraRay, sampler)
    while goesOn do
      val isHit = intersect()
      val lightWasSampled = !path.lightSamplingMisses
      if isHit then
        if !lightWasSampled then addEmission()
        val isLast = path.depth + path.passed == maxDepth
        if isLast || vertex.isInterface && !crosses then end()
        else if vertex.isInterface then
          path.passed += 1
          passThrough()
        else
          evaluate()
          if samplesLights && sampleLight(sampler) then connectBy(weight = _ => 1f)
          onward match
            case Onward.Bsdf => scatter(sampler)
            case Onward.Hemisphere =>
              scatterUniformly(vertex.bsdf.isTransmissive, sampler)
            case Onward.Sphere => scatterUniformly(bothSides = true, sampler)
          leaveVertex()
          if !samplesLights then path.startSegment(path.lastP, path.lastN, pdf = 0f)
      else if lightWasSampled then end()
      else addEnvironment()
    L.toRgb
