package candela.integrators

import candela.bsdf.{Bounce, Bsdf}
import candela.color.Rgb
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.lights.{EnvironmentLight, LightChoice, LightSample}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.{PathReport, Scene}

/** What the integrators that walk from the camera share: work space, and light sampling.
  *
  * @param volumes what dims light between surfaces, if anything does
  */
abstract class LightTransport(
    protected val scene: Scene,
    protected val volumes: VolumeMarch | Null = null
) extends Integrator:
  protected val hit = Hit()

  /** The point that is being lit. */
  protected var at = scene.newPoint()
  protected val shadowRay = Ray()
  protected val shadowHit = Hit()
  protected val chosen = LightChoice()
  protected val lightSample = LightSample()
  protected var rays = 0L

  protected val bounce = Bounce()

  // Work space of `sampleLight`: owned, so that no light sample makes garbage
  private val localWo, localTowards, localWi = Vec3(0f, 0f, 0f)
  protected val arrived = Rgb.Black.copy

  /** Where a direction was chosen last, on a surface with this normal (zero: in a medium). */
  protected val lastP, lastN = Vec3(0f, 0f, 0f)

  /** Takes it from `at`. */
  protected final def keepPlace(): Unit =
    lastP.become(at.p)
    lastN.become(at.frame.n)

  def raysTraced: Long =
    val march = volumes
    if march == null then rays else rays + march.raysTraced

  /** The next worker's, for a scene that is this one but for what it tells. */
  protected def over(scene: Scene): LightTransport
  final def copy(): Integrator = over(scene)
  final def reported(report: PathReport): Integrator = over(scene.reported(report))

  override def lastMaterial: Int = at.material

  /** Size of steps through volumes towards lights, in that of the steps towards the camera. */
  protected def stepsToLights: Float = VolumeMarch.StepsToLights

  /** Radiance of the surroundings along a ray that left the scene, each light weighted by `weight`
    * of its index and itself; to be used before the next is asked for.
    */
  protected inline def escaped(
      ray: Ray,
      inline weight: (Int, EnvironmentLight) => Float
  ): Rgb =
    val origin = ray.origin
    val direction = ray.direction
    arrived.become(Rgb.Black)
    var i = 0
    while i < scene.environments.length do
      val light = scene.environments(i)
      val w = weight(scene.environmentIndex(i), light)
      arrived.become(arrived + light.radiance(origin, direction) * w)
      i += 1
    arrived

  /** The same where light sampling competes with the direction of the ray.
    *
    * @param lastPdf of that direction, chosen at `lastP`; 0: light sampling was no choice
    */
  protected final def escaped(ray: Ray, lastPdf: Float): Rgb =
    escaped(
      ray,
      (i, source) =>
        if lastPdf > 0f then
          val pdf = source.pdf(lastP, ray.direction)
          LightTransport.metWeight(lastPdf, scene.selection.probability(lastP, lastN, i) * pdf)
        else 1f
    )

  /** What the surface at `at` emits to `wo` and adds to a path of this throughput, weighted in the
    * same way; black if it is no light.
    */
  protected final def metLight(throughput: Rgb, wo: Vec3, lastPdf: Float): Rgb =
    if at.areaLight < 0 then Rgb.Black
    else
      val source = scene.surfaceLight(at)
      val emitted = source.radiance(at, wo)
      if emitted.isBlack then Rgb.Black
      else
        val pdf =
          if lastPdf > 0f then
            scene.selection.probability(lastP, lastN, at.areaLight) * source.pdf(lastP, at)
          else 0f
        throughput * emitted * LightTransport.metWeight(lastPdf, pdf)

  /** One sample of the light that `light` sends to `at` and on to `wo` (world space).
    *
    * @param selected probability with which this light was chosen
    * @param combined weight by the power heuristic, because BSDF sampling finds this light too
    * @return         to be used before the next is asked for
    */
  protected def sampleLight(
      light: Int,
      selected: Float,
      bsdf: Bsdf,
      wo: Vec3,
      sampler: Sampler,
      combined: Boolean
  ): Rgb =
    val source = scene.lights(light)
    source.sample(at.p, sampler.x, sampler.y, lightSample)
    if !(lightSample.pdf > 0f) || lightSample.radiance.isBlack then Rgb.Black
    else
      val local = localWo
      local.become(at.frame.toLocal(wo))
      val towards = localTowards
      towards.become(at.frame.toLocal(lightSample.wi))
      val wi = localWi
      wi.become(onSide(towards, local, bsdf))
      val isPossible = isOpenSide(lightSample.wi, wo, bsdf)
      val f = if isPossible then bsdf.f(local, wi) else Rgb.Black
      if f.isBlack || isBlocked() then Rgb.Black
      else
        val pdf = selected * lightSample.pdf
        val weight =
          if combined && !source.isDelta then lightWeight(pdf, bsdf, local, towards) else 1f
        arrived.becomeProduct(f, lightSample.radiance, Math.abs(wi.z) * weight / pdf)
        val march = volumes
        if march != null then arrived.scaleBy(march.dimming(shadowRay, stepsToLights))
        arrived

  /** Light of one of the sources, chosen by `choice`; the point on it is the sampler's last. */
  protected final def oneLight(choice: Float, bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    scene.selection.choose(at.p, at.frame.n, choice, chosen)
    if chosen.light < 0 then Rgb.Black
    else sampleLight(chosen.light, chosen.probability, bsdf, wo, sampler, combined = true)

  /** The same, unless a BSDF or a scene leaves nothing to sample: that takes no numbers. */
  protected final def anyLight(bsdf: Bsdf, wo: Vec3, sampler: Sampler): Rgb =
    if bsdf.isSpecular || scene.lights.length == 0 then Rgb.Black
    else
      val choice = sampler.next1D()
      sampler.next2D()
      oneLight(choice, bsdf, wo, sampler)

  /** Draws a direction from a BSDF into `bounce`. */
  protected final def draw(bsdf: Bsdf, wo: Vec3, sampler: Sampler): Unit =
    val choice = sampler.next1D()
    sampler.next2D()
    bsdf.draw(wo, choice, sampler.x, sampler.y, bounce)

  /** Weight of a light sample of density `pdf` where BSDF sampling finds this light, too. */
  protected def lightWeight(pdf: Float, bsdf: Bsdf, wo: Vec3, wi: Vec3): Float =
    LightTransport.powerHeuristic(pdf, bsdf.pdf(wo, wi))

  /** Can a BSDF that only reflects send light from `wi` to `wo` (world space) at all? */
  protected final def isOpenSide(wi: Vec3, wo: Vec3, bsdf: Bsdf): Boolean =
    !scene.sidesByGeometry || bsdf.isTransmissive ||
      ((wi dot at.geometricNormal) > 0f) == ((wo dot at.geometricNormal) > 0f)

  /** The local `wi`, put on the side of `wo` if geometry has decided that it is a reflection. */
  protected final def onSide(wi: Vec3, wo: Vec3, bsdf: Bsdf): Vec3 =
    if !scene.sidesByGeometry || bsdf.isTransmissive || (wi.z > 0f) == (wo.z > 0f) then wi
    else Vec3(wi.x, wi.y, -wi.z)

  /** Is something between the shading point and the chosen point on the light? */
  protected final def isBlocked(): Boolean =
    LightTransport.towards(at.offsetOrigin(lightSample.wi), lightSample, shadowRay)
    rays += 1
    scene.isOccluded(shadowRay, shadowHit)

object LightTransport:
  /** Scattering events before which no path ends by chance. As in pbrt-v2 and v3; v4 has 1 for
    * paths, which costs more in noise than it saves in time: docs/SPEED.md.
    */
  inline val RouletteAfter = 4

  /** Where a shadow ray ends, as a part of the way to the light: the rounding of the difference of
    * its two ends, 2⁻²³ of its length at most, must not reach the light's own surface. The more
    * slanted that is, the sooner it does. What covers a light as closely is lost.
    *
    * @param cosine of the angle to the light's normal; 0 if it has none
    */
  def shadowEnd(cosine: Float): Float = 1f - Math.min(1f - ShadowEnd, 5e-6f / cosine)

  /** The soonest of these: it serves lights at any slant. */
  inline val ShadowEnd = 0.9999f

  /** Sets a ray from `origin` to the point that was sampled on a light. */
  def towards(origin: Vec3, sample: LightSample, ray: Ray): Unit =
    if sample.isInfinite then ray.set(origin, sample.wi, Float.PositiveInfinity)
    else
      ray.set(origin, end(sample) - origin, shadowEnd(sample.target.n absDot sample.wi))

  /** Of a shadow ray: beside the point on the light, so that it does not meet the light itself. */
  def end(sample: LightSample): Vec3 =
    val target = sample.target
    ShadingPoint.offset(target.p, target.pError, target.n, -sample.wi)

  /** Weight of a sample drawn with density `a` where `b` could have drawn it too.
    *
    * Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, §9.2.4, β =
    * 2.
    */
  def powerHeuristic(a: Float, b: Float): Float =
    if a == Float.PositiveInfinity then 1f
    else
      val r = b / a
      1f / (1f + r * r)

  /** Weight of light that a sampled direction met, which light sampling finds with density `pdf`.
    *
    * @param sampled density of the direction; 0: light sampling was no choice
    */
  def metWeight(sampled: Float, pdf: Float): Float =
    if sampled > 0f then powerHeuristic(sampled, pdf) else 1f

  /** Russian roulette: what the throughput of a path that goes on is multiplied by; 0: it ends.
    *
    * @param etaScale what refraction has made of radiance, which is no reason to end
    */
  def roulette(throughput: Rgb, etaScale: Float, threshold: Float, sampler: Sampler): Float =
    val q = throughput.largest * etaScale
    if q >= threshold then 1f else if sampler.next1D() < q then 1f / q else 0f
