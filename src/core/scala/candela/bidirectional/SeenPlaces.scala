package candela.bidirectional

import candela.base.Parallel
import candela.cameras.CameraRays
import candela.film.View
import candela.geometry.Ray
import candela.integrators.{PathLimits, PhotonLight, SurfaceWalk, VolumeWalk, Walk, WalkOptions}
import candela.math.*
import candela.sampling.IndependentSampler
import candela.scene.{CasterLearning, Scene}

import scala.collection.mutable.ArrayBuffer

/** Where paths from the camera come to surfaces that receive photons, or are scattered in media.
  * Mutable.
  *
  * @param looks      paths from the camera
  * @param onlyBehind only surfaces that the camera sees by way of specular ones, and what paths
  *                   meet from there on; else the first such place of each path
  */
private[bidirectional] final class SeenPlaces(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel,
    looks: Int,
    onlyBehind: Boolean
):
  import SeenPlaces.*
  private val parts = pool.map(Tasks)(i => Look(i * looks / Tasks, (i + 1) * looks / Tasks))
  private val places = parts.flatMap(_.found)

  /** The median size of pixels there; 0: there is none. */
  val footprint: Float =
    val sorted = parts.flatMap(_.sizes).sorted
    if sorted.isEmpty then 0f else sorted(sorted.length / 2)

  // As far apart as the places are, on average
  private val cell = (2.0 * footprint * Math.sqrt(view.pixels / looks)).toFloat
  private val seen = java.util.HashSet[Long]()
  if !isEmpty then
    for p <- places; k <- 0 until 8 do
      def near(x: Float, bit: Int) = x + (if (k >> bit & 1) == 0 then -0.5f else 0.5f) * cell
      seen.add(key(Vec3(near(p.x, 0), near(p.y, 1), near(p.z, 2)))): Unit

  def isEmpty: Boolean = !(footprint > 0f)

  /** Is the place near one of these? */
  def contains(p: Vec3): Boolean = seen.contains(key(p))

  /** Learns where light begins its way that arrives there. */
  def learn(): CasterLearning =
    val learning = CasterLearning()
    val each = CausticPilot.LearningPaths / Tasks
    pool.map(Tasks)(i => learn(i * each, (i + 1) * each)).foreach(learning.addAll)
    learning

  /** How many photons of other light than [[CausticPaths]] bring a path leaves here, in media. */
  def othersOfPath(): Double =
    val each = OtherPaths / Tasks
    val counts = pool.map(Tasks): part =>
      val within = light.within(scene)
      val paths = CausticPhotons.others(scene, light, within)
      val sampler = IndependentSampler(1, CausticPilot.Seed + 3)
      var found = 0
      for k <- part * each until (part + 1) * each do
        sampler.start(k, 0, 0)
        val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
        paths.trace(time, sampler, hero = (sampler.next1D() * 3f).toInt)
        for i <- 0 until paths.count do
          val vertex = paths(i)
          if vertex.isInMedium && !vertex.isCaustic && contains(vertex.at.p) then found += 1
      found
    counts.sum.toDouble / OtherPaths

  private def learn(from: Int, until: Int): CasterLearning =
    val learning = CasterLearning()
    val paths = light.photonPaths(scene, if onlyBehind then null else light.within(scene))
    val sampler = IndependentSampler(1, CausticPilot.Seed + 1)
    for k <- from until until do
      sampler.start(k, 0, 0)
      paths.trace(view.shutter.fold(0f)(_.at(sampler.next1D())), sampler)
      for i <- 0 until paths.count do
        val power = paths(i).throughput.average.toDouble
        if power < Float.PositiveInfinity && contains(paths(i).at.p) then
          learning.add(paths.place, power)
    learning

  private def key(p: Vec3): Long =
    def of(x: Float) = Math.floor(x.toDouble / cell).toLong & 0x1fffff
    of(p.x) << 42 | of(p.y) << 21 | of(p.z)

  /** Follows some of the paths. */
  private final class Look(from: Int, until: Int):
    val found = ArrayBuffer[Vec3]()
    val sizes = ArrayBuffer[Float]()
    private val sampler = IndependentSampler(1, CausticPilot.Seed)
    private val limits = PathLimits(light.maxDepth)
    private val walk: Walk = light.media match
      case Some(media) if !onlyBehind =>
        VolumeWalk(scene, media, WalkOptions(samplesLights = false))
      case _ => SurfaceWalk(scene)
    private val rays = CameraRays(view.camera, view.shutter, 0f)
    private val beside = CameraRays(view.camera, view.shutter, 0f)
    private val spread = SpreadPlaces(view)
    private var isWanted = false

    for k <- from until until do
      val x = spread.x(k).toFloat
      val y = spread.y(k).toFloat
      sampler.start(k, 0, 0)
      val weight = rays.next(x, y, sampler)
      sampler.start(k, 0, 0)
      if weight > 0f && beside.next(x + 1f, y, sampler) > 0f then follow(rays.ray)

    private def follow(ray: Ray): Unit =
      // Walking moves the ray
      val (eye, direction) = (ray.origin, ray.direction.normalized)
      var isFirst = true
      isWanted = !onlyBehind
      def see(p: Vec3): Unit =
        if isFirst then sizes += size(eye, direction, (p - eye).length)
        found += p
        isFirst = false
      walk.begin(ray, sampler)
      while walk.goesOn do
        val isHit = walk.trace()
        if !walk.travel(limits, sampler) then
          if walk.goesOn then see(walk.path.lastP.toVec3)
          walk.end()
        else if !isHit then walk.addEnvironment()
        else
          walk.meetSurface()
          if walk.isAtInterface then walk.passThrough()
          else if walk.hasHad(light.maxDepth) then walk.end()
          else scatter(see)

    private def scatter(see: Vec3 => Unit): Unit =
      walk.evaluate()
      val receives = PhotonLight.receives(scene, walk.vertex)
      if receives && isWanted then see(walk.vertex.at.p.toVec3)
      if receives && !onlyBehind then walk.end()
      else
        walk.scatter(sampler)
        if onlyBehind && walk.depth == 1 then isWanted = walk.vertex.bounce.isSpecular
        walk.leave()
        if onlyBehind && !isWanted then walk.end()

    /** Of a pixel, so far away. */
    private def size(eye: Vec3, direction: Vec3, distance: Float): Float =
      val other = beside.ray.origin + beside.ray.direction.normalized * distance
      (eye + direction * distance - other).length

private object SeenPlaces:
  /** Number of parallel tasks that trace the paths; results do not depend on threads. */
  inline val Tasks = 16
  inline val OtherPaths = 4096
