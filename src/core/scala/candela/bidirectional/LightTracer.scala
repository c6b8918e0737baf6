package candela.bidirectional

import candela.cameras.Camera
import candela.color.Rgb
import candela.film.Splats
import candela.geometry.Ray
import candela.integrators.{Integrator, LightTransport, SurfaceWalk}
import candela.sampling.Sampler
import candela.scene.Scene

/** Light tracing: all light but that of visible emitters comes by paths from the lights, connected
  * to the camera at every vertex. What the camera sees in mirrors and through smooth glass stays
  * black.
  *
  * @param splats   receives the splats
  * @param maxDepth scattering events of a path, at most
  * @param countsPassed as in [[candela.integrators.WalkOptions]]
  * @param showsSky does the camera see the sky where nothing is before it?
  *
  * Source: Arvo, "Backward Ray Tracing", SIGGRAPH 1986 course notes; PBRT 4th ed., §16.1.
  */
final class LightTracer(
    scene: Scene,
    imageCamera: Camera,
    splats: Splats,
    maxDepth: Int,
    countsPassed: Boolean = false,
    showsSky: Boolean = false
) extends Integrator:
  private val paths = LightPaths(
    scene,
    maxDepth,
    LightTransport.RouletteAfter,
    compresses = true,
    weighsAll = false,
    countsPassed = countsPassed
  )
  private val camera = CameraConnection(scene, imageCamera, splats)
  private val walk = SurfaceWalk(scene)

  def raysTraced: Long = walk.raysTraced + paths.raysTraced + camera.raysTraced
  override def lastMaterial: Int = walk.vertex.at.material

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    camera.begin(ray.time)
    paths.trace(ray.time, sampler)
    camera.connect(paths, isWeighted = false, sampler)
    walk.begin(ray, sampler)
    // As connections to the camera, which interfaces block
    if walk.intersect() then walk.addEmission()
    else if showsSky then walk.addEnvironment()
    walk.radiance
