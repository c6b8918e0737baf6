package candela.media

import candela.color.Rgb
import candela.geometry.{Bounds3, Ray}
import candela.math.*

/** All volumes of a scene; densities add up where they overlap. Immutable; scratch memory is a
  * [[RegionWork]].
  */
final class Regions(all: Array[Region]):
  def newWork(): RegionWork = RegionWork(all.length)

  def describe: String = Medium.summary(all.toSeq.map(_.describe))

  /** The longest way through all of them. */
  def extent: Float = Bounds3.of(all.flatMap(_.corners)).extent.length

  /** Sets `out.overlap` to the part of the ray, up to `ray.tMax`, from its first entry into a
    * region to its last exit from one.
    */
  def clip(ray: Ray, out: RegionWork): Boolean =
    var start = Float.PositiveInfinity
    var end = Float.NegativeInfinity
    var i = 0
    while i < all.length do
      if all(i).clip(ray, 0f, ray.tMax, out.overlap) then
        start = Math.min(start, out.overlap.start)
        end = Math.max(end, out.overlap.end)
      i += 1
    out.overlap.start = start
    out.overlap.end = end
    start < end

  /** Adds the optical depth of the ray between `from` and `to` to `out.depth…`: exact for uniform
    * regions, else by ray marching.
    *
    * @param unit   length of the ray's direction
    * @param step   step size, in scene units
    * @param offset offset of the first sample, as a fraction of a step
    */
  def addDepth(
      ray: Ray,
      from: Float,
      to: Float,
      unit: Float,
      step: Float,
      offset: Float,
      out: RegionWork
  ): Unit =
    var i = 0
    while i < all.length do
      val region = all(i)
      if region.clip(ray, from, to, out.overlap) then
        val length =
          if region.isUniform then (out.overlap.end - out.overlap.start) * unit
          else
            var sum = 0f
            val start = out.overlap.start * unit
            val end = out.overlap.end * unit
            // Shorter ones would not get on, far from the ray's origin
            val minLength = Math.max(Math.ulp(end), (end - start) / Regions.MaxSteps)
            val length = Math.max(step, minLength)
            var t = start + offset * length
            while t < end do
              sum += region.densityAt(ray.at(t / unit))
              t += length
            sum * length
        out.depthR += length * region.extinction.r
        out.depthG += length * region.extinction.g
        out.depthB += length * region.extinction.b
      i += 1

  /** Sets the coefficients at a point, and the density of each region. */
  def evaluate(p: Vec3, out: RegionWork): Unit =
    out.scatterR = 0f
    out.scatterG = 0f
    out.scatterB = 0f
    out.glowR = 0f
    out.glowG = 0f
    out.glowB = 0f
    var i = 0
    while i < all.length do
      val region = all(i)
      val d = region.densityAt(p)
      out.density(i) = d
      out.scatterR += d * region.scattering.r
      out.scatterG += d * region.scattering.g
      out.scatterB += d * region.scattering.b
      out.glowR += d * region.emitted.r
      out.glowG += d * region.emitted.g
      out.glowB += d * region.emitted.b
      i += 1

  /** Phase function of all regions from `wi` to `wo` at the point of the last [[at]]: the mean of
    * their phase functions, weighted by the luminance of their scattering coefficients.
    */
  def phase(wo: Vec3, wi: Vec3, work: RegionWork): Float =
    var sum, weights = 0f
    var i = 0
    while i < all.length do
      val weight = work.density(i) * all(i).scattering.luminance
      if weight > 0f then
        sum += weight * all(i).phase.value(wo, wi)
        weights += weight
      i += 1
    if weights > 0f then sum / weights else 0f

object Regions:
  /** Maximum number of steps along a ray through all regions. Others lead from each to the lights.
    */
  inline val MaxStepsAcross = 2048

  /** Maximum number of steps through a region, for any step size. */
  inline val MaxSteps = 65536

/** Scratch memory for traversing [[Regions]], one per worker. */
final class RegionWork(count: Int):
  val overlap = Overlap()
  private[media] val density = new Array[Float](count)

  /** Optical depth. */
  var depthR, depthG, depthB = 0f

  /** Scattering and emission at a point, per scene unit. */
  var scatterR, scatterG, scatterB = 0f
  var glowR, glowG, glowB = 0f

  def clearDepth(): Unit =
    depthR = 0f
    depthG = 0f
    depthB = 0f

  /** Transmittance of the optical depth. */
  def transmittance: Rgb = Rgb(exp(-depthR), exp(-depthG), exp(-depthB))

  def scatters: Boolean = scatterR > 0f || scatterG > 0f || scatterB > 0f
