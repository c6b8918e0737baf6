package candela.caustics

import candela.concurrency.Parallel
import candela.cameras.CameraRays
import candela.color.Rgb
import candela.film.View
import candela.geometry.{Ray, ShadingPoint}
import candela.integrators.{PhotonLight, SurfaceWalk}
import candela.math.*
import candela.media.{MediumWork, SceneMedia}
import candela.sampling.{IndependentSampler, Sampler}
import candela.scene.{CasterLearning, Scene}

import scala.collection.mutable.ArrayBuffer

/** Where paths from the camera come to surfaces that receive photons, or are scattered in media.
  * Mutable.
  *
  * @param looks paths from the camera
  */
private[candela] final class SeenPlaces(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel,
    looks: Int
):
  import SeenPlaces.*
  private val walks = pool.map(Tasks)(i => Look(i * looks / Tasks, (i + 1) * looks / Tasks))
  private val points = walks.flatMap(_.positions)

  /** The median size of pixels there; 0: there is none. */
  val footprint: Float =
    val sorted = walks.flatMap(_.sizes).sorted
    if sorted.isEmpty then 0f else sorted(sorted.length / 2)

  // As far apart as the places are, on average
  private val cell = (2.0 * footprint * Math.sqrt(view.pixels / looks)).toFloat
  private val cellKeys = java.util.HashSet[Long]()
  if !isEmpty then
    for p <- points; k <- 0 until 8 do
      def shifted(x: Float, bit: Int) = x + (if (k >> bit & 1) == 0 then -0.5f else 0.5f) * cell
      cellKeys.add(key(Vec3(shifted(p.x, 0), shifted(p.y, 1), shifted(p.z, 2)))): Unit

  def isEmpty: Boolean = !(footprint > 0f)

  /** Is the place near one of these? */
  def contains(p: Vec3): Boolean = cellKeys.contains(key(p))

  /** Learns where light begins its way that arrives there. */
  def learn(): CasterLearning =
    val learning = CasterLearning()
    val batchSize = CausticPilot.LearningPaths / Tasks
    pool.map(Tasks)(i => learn(i * batchSize, (i + 1) * batchSize)).foreach(learning.addAll)
    learning

  /** How many photons of other light than [[CausticPaths]] bring a path leaves here, in media. */
  def othersOfPath(): Double =
    val batchSize = OtherPaths / Tasks
    val counts = pool.map(Tasks): batch =>
      val pathMedia = light.pathMedia(scene)
      val paths = CausticPhotons.mediumPaths(scene, light, pathMedia)
      val sampler = IndependentSampler(1, CausticPilot.Seed + 3)
      var photonCount = 0
      for k <- batch * batchSize until (batch + 1) * batchSize do
        sampler.start(k, 0, 0)
        val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
        paths.trace(time, sampler, hero = (sampler.next1D() * 3f).toInt)
        for i <- 0 until paths.count do
          val vertex = paths(i)
          if vertex.isInMedium && !vertex.isCaustic && contains(vertex.point.p) then
            photonCount += 1
      photonCount
    counts.sum.toDouble / OtherPaths

  private def learn(from: Int, until: Int): CasterLearning =
    val learning = CasterLearning()
    val paths = light.photonPaths(scene, light.pathMedia(scene))
    val sampler = IndependentSampler(1, CausticPilot.Seed + 1)
    for k <- from until until do
      sampler.start(k, 0, 0)
      paths.trace(view.shutter.fold(0f)(_.at(sampler.next1D())), sampler)
      for i <- 0 until paths.count do
        val power = paths(i).throughput.average.toDouble
        if power < Float.PositiveInfinity && contains(paths(i).point.p) then
          learning.add(paths.casterPosition, power)
    learning

  private def key(p: Vec3): Long =
    def of(x: Float) = Math.floor(x.toDouble / cell).toLong & 0x1fffff
    of(p.x) << 42 | of(p.y) << 21 | of(p.z)

  /** Follows some of the paths. */
  private final class Look(from: Int, until: Int) extends SurfaceWalk(scene):
    val positions = ArrayBuffer[Vec3]()
    val sizes = ArrayBuffer[Float]()
    private val sampler = IndependentSampler(1, CausticPilot.Seed)
    private val mediumTracker = light.media.map(MediumAround(_))
    private val cameraRays = CameraRays(view.camera, view.shutter, 0f)
    private val beside = CameraRays(view.camera, view.shutter, 0f)
    private val spread = SpreadPlaces(view)

    for k <- from until until do
      val x = spread.x(k).toFloat
      val y = spread.y(k).toFloat
      sampler.start(k, 0, 0)
      val weight = cameraRays.next(x, y, sampler)
      sampler.start(k, 0, 0)
      if weight > 0f && beside.next(x + 1f, y, sampler) > 0f then
        radiance(cameraRays.ray, sampler): Unit

    def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
      // Walking moves the ray
      val (eye, direction) = (cameraRay.origin, cameraRay.direction.normalized)
      def record(p: Vec3): Unit =
        sizes += size(eye, direction, (p - eye).length)
        positions += p
      startPath(cameraRay, sampler)
      for medium <- mediumTracker do medium.startPath(sampler)
      while goesOn do
        val isHit = intersect()
        val t = mediumTracker.fold(-1f)(_.follow(ray, sampler))
        if mediumTracker.exists(_.isDark) then end()
        else if t >= 0f then
          if path.depth < light.maxDepth then record(ray.at(t))
          end()
        else if !isHit then end()
        else
          if isPassed then passThrough()
          else if path.depth == light.maxDepth then end()
          else scatter(record)
          for medium <- mediumTracker do medium.leaveSurface(vertex.point, ray, path.isAlone)
      L.toRgb

    private def scatter(see: Vec3 => Unit): Unit =
      evaluate()
      if PhotonLight.receives(scene, vertex) then
        see(vertex.point.p.toVec3)
        end()
      else
        scatter(sampler)
        leaveVertex()

    /** Of a pixel, so far away. */
    private def size(eye: Vec3, direction: Vec3, distance: Float): Float =
      val neighbour = beside.ray.origin + beside.ray.direction.normalized * distance
      (eye + direction * distance - neighbour).length

/** The medium around a path. Mutable.
  *
  * @param media of the scene
  */
private final class MediumAround(media: SceneMedia):
  private val work = MediumWork()
  private var medium = -1

  /** A path begins at the camera. */
  def startPath(sampler: Sampler): Unit =
    work.start(hero = if media.isChromatic then (sampler.next1D() * 3f).toInt else 0)
    work.random.seed(sampler.next1D(), sampler.next1D())
    medium = media.camera

  /** The ray's parameter of a scattering event; −1: none. */
  def follow(ray: Ray, sampler: Sampler): Float =
    if medium < 0 then -1f
    else media(medium).follow(ray, sampler.next1D(), emits = true, work)

  /** Does no light come through the media that the path has crossed? */
  def isDark: Boolean = work.weights.isDead

  /** The ray has left the surface, alone: with the hero wavelength only. */
  def leaveSurface(at: ShadingPoint, ray: Ray, isAlone: Boolean): Unit =
    if isAlone && !work.weights.isAlone then work.weights.keepHero()
    medium = media.beyond(at, ray.direction, medium)

private object SeenPlaces:
  /** Number of parallel tasks that trace the paths; results do not depend on threads. */
  inline val Tasks = 16
  inline val OtherPaths = 4096
