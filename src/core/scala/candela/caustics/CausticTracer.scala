package candela.caustics

import candela.bdpt.{BidirectionalPaths, CameraConnection, PathMedia}
import candela.aov.LightParts
import candela.cameras.CameraRays
import candela.color.Rgb
import candela.film.View
import candela.geometry.Ray
import candela.integrators.Integrator
import candela.media.SceneMedia
import candela.sampling.{IndependentSampler, Sampler}
import candela.scene.{Casters, Scene}

/** Light paths that look for caustics, and their way to the camera: all that is said of them.
  *
  * @param casters    where they begin
  * @param maxDepth   scattering events of a path, at most
  * @param compresses as in [[Subpath]]
  * @param findsAll   also trace light that paths from the camera cannot find
  * @param beneath    as in [[CausticPaths]]
  * @param media      what they go through, if anything
  */
final case class CausticLight(
    casters: Casters,
    maxDepth: Int,
    compresses: Boolean,
    findsAll: Boolean,
    beneath: Boolean,
    media: Option[SceneMedia]
):
  private[candela] def pathMedia(scene: Scene): PathMedia | Null =
    media.map(PathMedia(scene, _)).orNull

  /** May photons bring all that media scatter? They leave out what media emit in the colours of the
    * scene, which differ between the bases of spectral rendering, and what is sent from beneath
    * surfaces.
    */
  private[candela] def suitsPhotons: Boolean =
    !beneath && media.exists(!_.isEmissive)

  /** Is the camera in the medium that the first border before it says? Else light paths, which come
    * through borders, and the camera's find different images.
    */
  private[candela] def isCameraWhereItSays(scene: Scene, view: View): Boolean =
    val through = pathMedia(scene)
    through == null || {
      val pairs = CameraPairs(view, CausticPilot.Seed + 2)
      val rays = CameraRays(view.camera, view.shutter, 0f)
      val sampler = IndependentSampler(1, CausticPilot.Seed)
      (0 until CausticLight.CameraRaysLooked).forall: k =>
        CameraPairs.start(view, sampler, k)
        val weight = rays.next(pairs.pixelX(k) + 0.5f, pairs.pixelY(k) + 0.5f, sampler)
        weight == 0f || !through.contradicts(rays.ray)
    }

  private[candela] def photonPaths(scene: Scene, pathMedia: PathMedia | Null): CausticPaths =
    val onlyToFirst = true
    CausticPaths(scene, casters, maxDepth, compresses, findsAll, beneath, pathMedia, onlyToFirst)

  private[candela] def paths(scene: Scene, pathMedia: PathMedia | Null): CausticPaths =
    CausticPaths(scene, casters, maxDepth, compresses, findsAll, beneath, pathMedia)

  /** May photons begin at all emitters? In fog without end, those from infinity would begin closer
    * than where light samples do.
    */
  private[candela] def beginsAtEmitters(scene: Scene): Boolean =
    !beneath && media.exists: all =>
      lazy val isEndless = PathMedia.beyondAll(scene, all) >= 0
      !scene.lights.indices.exists: i =>
        scene.lights(i).isInfinite && (all.lights(i) >= 0 || isEndless)

object CausticLight:
  private inline val CameraRaysLooked = 64

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
