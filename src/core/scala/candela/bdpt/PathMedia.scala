package candela.bdpt

import candela.color.Rgb
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.integrators.MediumVisibility
import candela.lights.LightSample
import candela.math.*
import candela.media.{MediumWork, SceneMedia}
import candela.sampling.Sampler
import candela.scene.Scene

/** A subpath's way through participating media: the medium around it, the weights of its sampling
  * by colours ([[candela.media.PathWeights]]), and its connections. Mutable, one per subpath.
  *
  * Multiple importance sampling leaves the densities of distances in media out, for all strategies
  * alike.
  */
private[candela] final class PathMedia(scene: Scene, media: SceneMedia):
  import PathMedia.Unknown
  private val work = MediumWork()
  private val weights = work.weights
  private val visibility = MediumVisibility(scene, media, work)
  private val lobes = media.lobes
  private val ahead = Ray()
  private val hit = Hit()
  private val border = ShadingPoint()
  private var rays = 0L
  private val beyondAll = PathMedia.beyondAll(scene, media)

  /** Index of the medium around the path, −1: none. */
  var medium: Int = -1

  def raysTraced: Long = rays + visibility.raysTraced
  def isAbsorbed: Boolean = weights.isDead
  def throughput: Rgb = weights.throughput

  /** Radiance that media emit towards the start of the path. */
  def glow: Rgb = Rgb(work.glowR, work.glowG, work.glowB)

  /** Starts a path. Both subpaths of a path have the same hero.
    *
    * @param hero of the colours
    */
  def startPath(hero: Int, start: Int, time: Float, sampler: Sampler): Unit =
    work.start(hero)
    work.random.seed(sampler.next1D(), sampler.next1D())
    visibility.start(time)
    medium = start

  /** Index of the medium at the origin of a light's ray: as declared around a light without a
    * surface, as in pbrt; otherwise as the borders tell, first of all the light's own surface.
    */
  def mediumAt(light: Int, ray: Ray): Int =
    val declared = media.lights(light)
    if declared >= 0 then declared
    else
      val adjacent = if scene.lights(light).asSurface == null then Unknown else beyondOwn(ray)
      if adjacent == Unknown then mediumAt(ray) else adjacent

  /** What the surface that the ray has left says of the medium before it. */
  private def beyondOwn(ray: Ray): Int =
    ahead.time = ray.time
    ahead.set(ray.origin, -ray.direction, Float.PositiveInfinity)
    rays += 1
    if !scene.closest(ahead, hit) then Unknown
    else
      scene.surface(ahead, hit, border)
      media.beyond(border, ray.direction, Unknown)

  /** Index of the medium at the ray's origin: that on the near side of the first border of media in
    * its direction, or else that beyond all borders.
    */
  private def mediumAt(ray: Ray): Int = firstBorder(ray, beyondAll)

  /** Is the camera in another medium than the first border says that its ray meets? Then light
    * paths, which come through borders, find another image than those that begin in the camera.
    */
  def contradicts(ray: Ray): Boolean = firstBorder(ray, media.camera) != media.camera

  private def firstBorder(ray: Ray, otherwise: Int): Int =
    ahead.time = ray.time
    ahead.set(ray.origin, ray.direction, Float.PositiveInfinity)
    var result = otherwise
    var goesOn = true
    while goesOn do
      rays += 1
      goesOn = scene.closest(ahead, hit)
      if goesOn then
        scene.surface(ahead, hit, border)
        val direction = ahead.direction
        // Only a border tells its sides apart
        if media.beyond(border, direction, Unknown) != Unknown then
          result = media.beyond(border, -direction, -1)
          goesOn = false
        else ahead.set(border.offsetOrigin(direction), direction, Float.PositiveInfinity)
    result

  /** Goes along `ray` to a collision before its end.
    *
    * @param carried throughput of the surfaces since the last segment
    * @return the ray's parameter of a scattering event; −1: none
    */
  def follow(ray: Ray, carried: Rgb, emits: Boolean, sampler: Sampler): Float =
    weights.scale(carried)
    if medium < 0 then -1f else media(medium).follow(ray, sampler.next1D(), emits, work)

  /** Puts the vertex where the medium scatters. */
  def scatter(vertex: PathVertex, ray: Ray, t: Float): Unit =
    vertex.scatterAt(ray.at(t), -ray.direction, lobes(medium))
    ray.differential.isKnown = false

  /** Remembers in the vertex what connections to it need. */
  def mark(vertex: PathVertex): Unit =
    vertex.medium = medium
    vertex.ur = weights.ur
    vertex.ug = weights.ug
    vertex.ub = weights.ub

  /** Index of the medium towards `w` from the vertex. */
  def towards(vertex: PathVertex, w: Vec3): Int =
    if vertex.isInMedium then vertex.medium else media.beyond(vertex.point, w, vertex.medium)

  /** Passes the interface that the vertex lies on. */
  def passThrough(vertex: PathVertex, ray: Ray): Unit =
    medium = media.beyond(vertex.point, ray.direction, medium)
    vertex.passThrough(ray)

  /** What media leave of a light's sample, over the density of sampling by colours. */
  def fromLight(vertex: PathVertex, sample: LightSample): Rgb =
    val wi = sample.wi
    if visibility.reaches(vertex.point.offsetOrigin(wi), sample, towards(vertex, wi)) then
      shadow(weights.ur, weights.ug, weights.ub)
    else Rgb.Black

  /** Likewise, of light between the vertices of the two subpaths. */
  def betweenVertices(vertex: PathVertex, other: PathVertex, wi: Vec3): Rgb =
    val (origin, end) = (vertex.point.offsetOrigin(wi), other.point.offsetOrigin(-wi))
    if visibility.reaches(origin, end, towards(vertex, wi)) then
      shadow(weights.ur * other.ur, weights.ug * other.ug, weights.ub * other.ub)
    else Rgb.Black

  /** Likewise, of light from a vertex of the light subpath to the camera. */
  def toCamera(vertex: PathVertex, wi: Vec3, eye: Vec3): Rgb =
    if visibility.reaches(vertex.point.offsetOrigin(wi), eye, towards(vertex, wi)) then
      shadow(vertex.ur, vertex.ug, vertex.ub)
    else Rgb.Black

  private def shadow(ur: Float, ug: Float, ub: Float): Rgb =
    val s = work.shadow
    val density = (ur * s.lr + ug * s.lg + ub * s.lb) * (1f / 3f)
    if density > 0f then s.throughput * (1f / density) else Rgb.Black

private[candela] object PathMedia:
  /** No index of a medium. */
  private inline val Unknown = -2

  /** Index of the medium beyond all borders, found from the camera; −1: none. */
  def beyondAll(scene: Scene, media: SceneMedia): Int =
    val (ahead, hit, border) = (Ray(), Hit(), ShadingPoint())
    val direction = Vec3.Z
    ahead.set(media.eye, direction, Float.PositiveInfinity)
    var result = media.camera
    while scene.closest(ahead, hit) do
      scene.surface(ahead, hit, border)
      result = media.beyond(border, direction, result)
      ahead.set(border.offsetOrigin(direction), direction, Float.PositiveInfinity)
    result
