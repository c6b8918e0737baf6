package candela.bdpt

import candela.cameras.Camera
import candela.color.Rgb
import candela.film.Splats
import candela.geometry.Ray
import candela.integrators.{LightTransport, SurfaceWalk}
import candela.sampling.Sampler
import candela.scene.Scene

/** Light tracing: all light but that of visible emitters comes by paths from the lights, connected
  * to the camera at every vertex. What the camera sees in mirrors and through smooth glass stays
  * black.
  *
  * @param splats   receives the splats
  * @param maxDepth scattering events of a path, at most
  * @param countsPassed as in [[candela.integrators.PathOptions]]
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
) extends SurfaceWalk(scene):
  private val paths = LightPaths(
    scene,
    maxDepth,
    LightTransport.SubpathRouletteDepth,
    compresses = true,
    weighsAll = false,
    countsPassed = countsPassed
  )
  private val camera = CameraConnection(scene, imageCamera, splats)

  override def raysTraced: Long = super.raysTraced + paths.raysTraced + camera.raysTraced

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    camera.startSample(cameraRay.time)
    paths.trace(cameraRay.time, sampler)
    camera.connect(paths, isWeighted = false, sampler)
    startPath(cameraRay, sampler)
    // As connections to the camera, which interfaces block
    if intersect() then addEmission()
    else if showsSky then addEnvironment()
    L.toRgb
