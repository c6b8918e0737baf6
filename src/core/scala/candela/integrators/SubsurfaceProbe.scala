package candela.integrators

import candela.bsdf.Bssrdf
import candela.color.Rgb
import candela.geometry.{Frame, Hit, Ray, ShadingPoint}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Samples the point where light that exits a translucent surface entered it, by probe rays along
  * one of three axes. Mutable, one per worker.
  *
  * @param acrossMaterials if true, light may enter any material with a BSSRDF, else only the same
  *
  * Source: King et al., "BSSRDF Importance Sampling", SIGGRAPH 2013 Talks; PBRT 3rd ed., §15.4.1.
  */
final class SubsurfaceProbe(scene: Scene, acrossMaterials: Boolean = false):
  private val ray = Ray()
  private val point = ShadingPoint()
  private var hit = Hit()
  private var chosen = Hit()
  private val chosenFrom = MutableVec3()
  private var chosenAt = 0f
  private var traced = 0L

  def raysTraced: Long = traced

  /** Samples a point of entry for light that exits at `at`.
    *
    * @param entry set to the point of entry; may be `at` itself
    * @return      BSSRDF over the area density of the point; black if there is none, and `entry` is
    *              unchanged
    */
  def enter(
      at: ShadingPoint,
      inside: Bssrdf,
      time: Float,
      sampler: Sampler,
      entry: ShadingPoint
  ): Rgb =
    val choice = sampler.next1D()
    sampler.next2D()
    // Half of the probe rays follow the normal, a quarter each tangent
    val axis = if choice < 0.5f then 2 else if choice < 0.75f then 0 else 1
    val remapped = if axis == 2 then 2f * choice else 4f * choice - (2f + axis)
    val channel = Math.min((3f * remapped).toInt, 2)
    val radius = inside.sample(channel, sampler.x)
    val reach = inside.reach(channel)
    if !(radius >= 0f && radius < reach) then Rgb.Black
    else
      val phi = TwoPi * sampler.y
      val halfLength = sqrt(reach * reach - radius * radius)
      val x = radius * cos(phi)
      val y = radius * sin(phi)
      val p = at.p.toVec3
      val frame = at.frame.toFrame
      val (start, direction) = axis match
        case 0 => (p + frame.t * x + frame.n * y - frame.s * halfLength, frame.s)
        case 1 => (p + frame.n * x + frame.s * y - frame.t * halfLength, frame.t)
        case _ => (p + frame.s * x + frame.t * y - frame.n * halfLength, frame.n)
      ray.time = time
      val count = walk(start, direction, 2f * halfLength, at.material, 3f * remapped - channel)
      if count == 0 then Rgb.Black
      else
        ray.set(chosenFrom, direction, chosenAt)
        scene.surface(ray, chosen, entry)
        val density = pdf(p, frame, inside, entry)
        if density > 0f then inside((p - entry.p).length) * (count / density) else Rgb.Black

  /** Chooses uniformly among the intersections of the segment with surfaces that light can enter.
    *
    * @param u uniform in [0, 1)
    * @return  number of these intersections
    */
  private def walk(start: Vec3, direction: Vec3, length: Float, material: Int, u: Float): Int =
    var origin = start
    var remaining = length
    var choice = u
    var count = 0
    var crossings = 0
    var goesOn = true
    while goesOn do
      ray.set(origin, direction, remaining)
      traced += 1
      goesOn = scene.closest(ray, hit)
      if goesOn then
        scene.surface(ray, hit, point)
        if isEntry(point.material, material) then
          count += 1
          // Reservoir sampling: the n-th replaces the earlier choice with probability 1/n
          if choice * count < 1f then
            choice *= count
            val free = chosen
            chosen = hit
            hit = free
            chosenFrom.set(origin)
            chosenAt = ray.tMax
          else choice = (choice * count - 1f) / (count - 1)
        origin = point.offsetOrigin(direction)
        remaining = length - ((origin - start) dot direction)
        // Surfaces that touch are crossed at one distance
        crossings += 1
        goesOn = remaining > 0f && crossings < SubsurfaceProbe.MaxCrossings
    count

  private def isEntry(there: Int, here: Int): Boolean =
    if acrossMaterials then scene.isSubsurface(there) else scene.isSameMaterial(there, here)

  /** Area density of the point of entry, summed over the axes (MIS by the balance heuristic). */
  private def pdf(p: Vec3, frame: Frame, inside: Bssrdf, entry: ShadingPoint): Float =
    val d = frame.toLocal(entry.p - p)
    val n = frame.toLocal(entry.geometricNormal)
    0.25f * Math.abs(n.x) * inside.density(sqrt(d.y * d.y + d.z * d.z)) +
      0.25f * Math.abs(n.y) * inside.density(sqrt(d.z * d.z + d.x * d.x)) +
      0.5f * Math.abs(n.z) * inside.density(sqrt(d.x * d.x + d.y * d.y))

object SubsurfaceProbe:
  /** Limit of crossings, so that every probe ray ends. */
  private inline val MaxCrossings = 10000
