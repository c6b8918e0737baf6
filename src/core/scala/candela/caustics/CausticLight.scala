package candela.caustics

import candela.bdpt.PathMedia
import candela.cameras.CameraRays
import candela.film.View
import candela.media.SceneMedia
import candela.sampling.IndependentSampler
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
