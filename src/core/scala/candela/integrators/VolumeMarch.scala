package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.media.Regions
import candela.sampling.{RandomStream, Sampler}
import candela.scene.Scene

/** Ray marching through pbrt-v2's volumes: emission and, if `scatters`, single scattering. The step
  * size affects the image: as in pbrt-v2, the transmittance up to the last step's sample stands for
  * that of the whole segment, and steps towards lights are four times as large.
  *
  * Mutable, one per worker.
  *
  * @param stepSize in scene units
  *
  * Source: PBRT 2nd ed., §16.3 and §16.4.
  */
final class VolumeMarch(scene: Scene, regions: Regions, stepSize: Float, scatters: Boolean):
  private val work = regions.newWork()
  private val connection = LightConnection(scene)
  private val random = RandomStream()

  /** What the volumes add along the ray of the last [[march]], and their transmittance. */
  var added, transmitted: Rgb = Rgb.Black

  def raysTraced: Long = connection.raysTraced

  /** Starts a new camera path. */
  def start(ray: Ray, sampler: Sampler): Unit =
    connection.startPath(ray.time)
    random.seed(sampler.next1D(), sampler.next1D())

  /** Marches along the ray up to `ray.tMax`.
    *
    * @param parts also receives what the volumes add, if given
    */
  def march(ray: Ray, sampler: Sampler, parts: LightParts | Null = null): Unit =
    added = Rgb.Black
    transmitted = Rgb.White
    if regions.clip(ray, work) then
      val unit = ray.direction.length
      val start = work.overlap.start
      val end = work.overlap.end
      val wanted = Math.ceil(((end - start) * unit / stepSize).toDouble).toInt
      val count = clamp(wanted, 1, Regions.MaxSteps)
      val step = (end - start) / count
      val offset = sampler.next1D()
      work.clearDepth()
      var boost = 1f
      var sumR, sumG, sumB = 0f
      var previous = start
      var i = 0
      while i < count do
        val t = start + (i + offset) * step
        regions.addDepth(ray, previous, t, unit, 0.5f * stepSize, random.next(), work)
        previous = t
        val remaining = work.transmittance * boost
        // Russian roulette where hardly any light gets through
        if remaining.luminance < VolumeMarch.Faint then
          if random.next() < 0.5f then boost *= 2f
          else
            boost = 0f
            i = count
        if boost > 0f then
          val reaching = work.transmittance * boost
          val p = ray.at(t)
          regions.evaluate(p, work)
          sumR += reaching.r * work.glowR
          sumG += reaching.g * work.glowG
          sumB += reaching.b * work.glowB
          if parts != null then
            val glow = Rgb(work.glowR, work.glowG, work.glowB)
            parts.addGlow(0, reaching * glow * (step * unit))
          if scatters && work.scatters && scene.lights.length > 0 then
            val dr = work.depthR
            val dg = work.depthG
            val db = work.depthB
            val arrived = scattered(p, -ray.direction * (1f / unit))
            work.depthR = dr
            work.depthG = dg
            work.depthB = db
            sumR += reaching.r * arrived.r
            sumG += reaching.g * arrived.g
            sumB += reaching.b * arrived.b
            if parts != null then
              parts.addLight(connection.index, 1, reaching * arrived * (step * unit))
        i += 1
      added = Rgb(sumR, sumG, sumB) * (step * unit)
      transmitted = work.transmittance * boost

  /** Direct light of one sampled light, scattered to `wo`, per scene unit. */
  private def scattered(p: Vec3, wo: Vec3): Rgb =
    if !connection.choose(p, Vec3.Zero, random.next()) ||
      !connection.samplePoint(p, random.next(), random.next()) || connection.isBlocked(p)
    then Rgb.Black
    else
      val phase = regions.phase(wo, connection.wi, work)
      val source =
        Rgb(work.scatterR, work.scatterG, work.scatterB) * connection.sample.radiance.toRgb
      source * connection.transmittance(this) * (phase / connection.pdf)

  /** Transmittance along the ray up to `ray.tMax`.
    *
    * @param steps step size, in units of that towards the camera
    */
  def transmittance(ray: Ray, steps: Float): Rgb =
    work.clearDepth()
    val unit = ray.direction.length
    regions.addDepth(ray, 0f, ray.tMax, unit, steps * stepSize, random.next(), work)
    work.transmittance

object VolumeMarch:
  private val Faint = 1e-3f

  /** Step size towards lights, in units of that along the camera ray, as in pbrt-v2. */
  inline val StepsToLights = 4f
