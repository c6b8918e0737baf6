package candela.caustics

import candela.bdpt.{BidirectionalPaths, CameraConnection}
import candela.aov.LightParts
import candela.color.Rgb
import candela.film.View
import candela.geometry.Ray
import candela.integrators.Integrator
import candela.sampling.Sampler
import candela.scene.Scene

/** Path tracing, with light paths for caustics, and for what these light: light that casters
  * scatter, and that a surface or a medium before the camera sends on. Where both find the same
  * light, both are weighted by multiple importance sampling.
  *
  * @param tracer    weighs what it finds by [[candela.integrators.CausticWeights]]
  * @param perSample light paths per camera sample, on average
  *
  * Source: Veach 1997, §10: light tracing is his strategy t = 1, of which only caustics are taken.
  */
final class CausticTracer(
    scene: Scene,
    tracer: Integrator,
    view: View,
    light: CausticLight,
    perSample: Float
) extends Integrator:
  private val pathMedia = light.pathMedia(scene)
  private val paths = light.paths(scene, pathMedia)
  private val camera = CameraConnection(scene, view.camera, view.splats, pathMedia)

  def raysTraced: Long = tracer.raysTraced + paths.raysTraced + camera.raysTraced +
    (if pathMedia == null then 0L else pathMedia.raysTraced)

  override def lastMaterial: Int = tracer.lastMaterial
  override def lightParts: LightParts | Null = tracer.lightParts

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    val time = ray.time
    val estimate = tracer.radiance(ray, sampler)
    camera.startSample(time)
    sampler.skipTo(BidirectionalPaths.LightRequests)
    var remaining = perSample
    while isNext(remaining, sampler) do
      paths.trace(time, sampler)
      camera.connect(paths, isWeighted = true, sampler, perSample)
      remaining -= 1f
    estimate

  /** Is another path traced, of as many as are left on average? */
  private def isNext(left: Float, sampler: Sampler): Boolean =
    left > 0f && (left >= 1f || sampler.next1D() < left)
