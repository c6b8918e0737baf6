package candela.bidirectional

import candela.cameras.CameraRays
import candela.film.View
import candela.geometry.Ray
import candela.integrators.{PhotonLight, SurfaceWalk}
import candela.math.*
import candela.sampling.{IndependentSampler, Sampler}
import candela.scene.{CasterLearning, Scene}

/** Finds out which photons arrive where the camera sees them, and how large a pixel is there.
  * Depends on the scene and its camera alone, as [[CausticPilot]].
  */
private[candela] final class PhotonPilot(scene: Scene, view: View, light: CausticLight):
  import PhotonPilot.*
  private val seen = java.util.HashSet[Long]()
  private var cell = 1f

  /** @return the choice, if there are such photons; and what is done, or why nothing is */
  def run(): (Option[CausticChoice], String) =
    val (places, footprint) = look()
    if places.isEmpty || !(footprint > 0f) then
      (None, "none: the camera sees no surface that receives photons")
    else
      // As far apart as the places are, on average
      cell = (2.0 * footprint * Math.sqrt(view.pixels / Looks)).toFloat
      for p <- places do seen.add(key(p)): Unit
      val learning = learn()
      if learning.isEmpty then (None, "none: no photons arrive where the camera sees them")
      else
        val radius = Pixels * footprint
        val aimed = light.casters.aimed(learning.aim)
        val told =
          f"photons of light that casters scatter, gathered within a radius of $radius%.3g " +
            "in the first pass, and less in each that follows; the image is biased"
        (Some(CausticChoice(aimed, 1f, radius)), told)

  /** The places that the camera sees, and the median size of pixels there. */
  private def look(): (Vector[Vec3], Float) =
    val rays = CameraRays(view.camera, view.shutter, 0f)
    val beside = CameraRays(view.camera, view.shutter, 0f)
    val walk = SurfaceWalk(scene)
    val spread = SpreadPlaces(view)
    val sampler = IndependentSampler(1, CausticPilot.Seed)
    val places = Vector.newBuilder[Vec3]
    val sizes = Array.newBuilder[Float]
    for k <- 0 until Looks do
      val x = spread.x(k).toFloat
      val y = spread.y(k).toFloat
      sampler.start(k, 0, 0)
      val weight = rays.next(x, y, sampler)
      sampler.start(k, 0, 0)
      if weight > 0f && beside.next(x + 1f, y, sampler) > 0f then
        val (eye, direction) = (rays.ray.origin, rays.ray.direction.normalized)
        if arrives(walk, rays.ray, sampler) then
          val p = walk.vertex.at.p.toVec3
          val distance = (p - eye).length
          val other = beside.ray.origin + beside.ray.direction.normalized * distance
          places += p
          sizes += (eye + direction * distance - other).length
    val sorted = sizes.result().sorted
    (places.result(), if sorted.isEmpty then 0f else sorted(sorted.length / 2))

  /** Does the path come to a surface that receives photons? */
  private def arrives(walk: SurfaceWalk, ray: Ray, sampler: Sampler): Boolean =
    var isThere = false
    walk.begin(ray, sampler)
    while walk.goesOn do
      if !walk.intersect() then walk.addEnvironment()
      else if walk.isAtInterface then walk.passThrough()
      else if walk.hasHad(light.maxDepth) then walk.end()
      else
        walk.evaluate()
        isThere = PhotonLight.receives(scene, walk.vertex)
        if isThere then walk.end()
        else
          walk.scatter(sampler)
          walk.leave()
    isThere

  /** Learns from light that arrives at these places. */
  private def learn(): CasterLearning =
    val learning = CasterLearning()
    val paths = light.photonPaths(scene)
    val sampler = IndependentSampler(1, CausticPilot.Seed + 1)
    for k <- 0 until CausticPilot.LearningPaths do
      sampler.start(k, 0, 0)
      paths.trace(view.shutter.fold(0f)(_.at(sampler.next1D())), sampler)
      for i <- 0 until paths.count do
        val power = paths(i).throughput.average.toDouble
        if power < Float.PositiveInfinity && seen.contains(key(paths(i).at.p)) then
          learning.add(paths.place, power)
    learning

  private def key(p: Vec3): Long =
    def of(x: Float) = Math.floor(x.toDouble / cell).toLong & 0x1fffff
    of(p.x) << 42 | of(p.y) << 21 | of(p.z)

private[candela] object PhotonPilot:
  /** Paths of the camera. */
  inline val Looks = 4096

  /** The first radius, in pixels: each gathers some ten photons where they are evenly spread. */
  inline val Pixels = 2f
