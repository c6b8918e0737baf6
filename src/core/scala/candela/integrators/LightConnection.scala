package candela.integrators

import candela.color.{MutableRgb, Rgb}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.lights.{LightChoice, LightSample}
import candela.math.*
import candela.scene.Scene

/** Next-event estimation: a point sampled on a light, and the shadow ray to it. Mutable, one per
  * worker.
  *
  * @param volumes what attenuates light between surfaces, if anything does
  * @param steps   their step size towards lights, in units of that towards the camera
  * @param passesInterfaces do shadow rays pass interfaces?
  */
final class LightConnection(
    scene: Scene,
    volumes: VolumeMarch | Null = null,
    steps: Float = VolumeMarch.StepsToLights,
    passesInterfaces: Boolean = true
):
  private val examines = passesInterfaces && scene.hasInterfaces
  private val choice = LightChoice()
  private val ray = Ray()
  private val hit = Hit()
  private val border = ShadingPoint()
  private var rays = 0L

  /** Does the choice of a light depend on the random number? */
  val isRandom: Boolean = scene.selection.isRandom

  /** The point on the light. */
  val sample: LightSample = LightSample()

  /** Direction towards it in the frame of the surface that [[scattered]] was asked for. */
  val localWi: MutableVec3 = MutableVec3()

  def raysTraced: Long = rays

  /** A new camera path starts. */
  def startPath(time: Float): Unit = ray.time = time

  /** Chooses one light for a point with normal `n`, as [[LightSelection]]; false if none can
    * contribute.
    *
    * @param u uniform in [0, 1)
    */
  def choose(p: Vec3, n: Vec3, u: Float): Boolean =
    scene.selection.choose(p, n, u, choice)
    choice.light >= 0

  /** Chooses a given light, as often as `times` for one sample. */
  def choose(light: Int, times: Float = 1f): Unit =
    choice.light = light
    choice.probability = times

  /** Samples a point on the chosen light as seen from `p`; false if it contributes nothing. */
  def samplePoint(p: Vec3, u1: Float, u2: Float): Boolean =
    scene.lights(choice.light).sample(p, u1, u2, sample)
    sample.isLit

  /** Index of the chosen light. */
  def index: Int = choice.light

  /** Probability of the choice. */
  def probability: Float = choice.probability

  /** Unit vector towards the point. */
  def wi: MutableVec3 = sample.wi

  /** Density of the sample: probability of the light times solid-angle density of the point. */
  def pdf: Float = choice.probability * sample.pdf

  /** Density with which a path from the light begins at the sample's point and comes from there. */
  def emissionPdf: Float =
    val target = sample.target
    scene.lights(choice.light).emissionPdf(scene.ball, target.p, target.n, -wi)

  /** What [[emissionPdf]] is divided by for the density with which such a path arrives at `p`,
    * across its way, relative to that of the sample's point.
    */
  def spread(p: Vec3): Float =
    val target = sample.target
    if sample.isInfinite then sample.pdf
    else if target.n.isZero then (target.p - p).lengthSquared
    else sample.pdf * (target.n absDot wi)

  /** True if no direction sampled from a BSDF can meet the light. */
  def isDelta: Boolean = scene.lights(choice.light).isDelta
  def isShownOnly: Boolean = scene.lights(choice.light).isShownOnly

  /** Traces the shadow ray from a surface. */
  def isBlocked(at: ShadingPoint): Boolean = isBlocked(at.offsetOrigin(wi))

  /** Traces the shadow ray from `origin`, through interfaces where it passes them. */
  def isBlocked(origin: Vec3): Boolean =
    aim(origin)
    rays += 1
    if !examines then scene.isOccluded(ray, hit)
    else
      def opens = scene.isInterface(border)
      !LightConnection.reaches(scene, ray, hit, border, opens, _ => rays += 1, true, aim)

  /** Sets the shadow ray. */
  private def aim(origin: Vec3): Unit =
    if sample.isInfinite then ray.set(origin, wi, Float.PositiveInfinity)
    else
      val end = LightConnection.end(sample)
      ray.set(origin, end - origin, LightConnection.shadowEnd(sample.target.n absDot wi))

  /** What volumes leave of the light along the shadow ray traced last. */
  def transmittance(march: VolumeMarch): Rgb = march.transmittance(ray, steps)

  /** What [[computeArrived]] has computed, not yet weighted with the path's throughput. */
  val arrived: MutableRgb = MutableRgb()

  /** Traces the shadow ray, and computes what `vertex` scatters of the sample to its `wo`; false if
    * none arrives.
    *
    * @param weight of multiple importance sampling, given the local direction to the light;
    *               evaluated only if the sample is visible and BSDF sampling can find the light,
    *               else 1
    */
  inline def computeArrived(vertex: SurfaceVertex, inline weight: Vec3 => Float): Boolean =
    vertex.point.frame.toLocal(wi, localWi)
    val f = vertex.received(wi, localWi)
    val arrives = !f.isBlack && !isBlocked(vertex.point)
    if arrives then arrive(f, Math.abs(localWi.z) * (if isDelta then 1f else weight(localWi)) / pdf)
    arrives

  /** [[arrived]], or black. */
  inline def scattered(vertex: SurfaceVertex, inline weight: Vec3 => Float): Rgb =
    if computeArrived(vertex, weight) then arrived.toRgb else Rgb.Black

  /** f · radiance · factor, attenuated by volumes. */
  def arrive(f: Rgb, factor: Float): Unit =
    val radiance = sample.radiance
    arrived.r = f.r * radiance.r * factor
    arrived.g = f.g * radiance.g * factor
    arrived.b = f.b * radiance.b * factor
    val march = volumes
    if march != null then arrived.scale(transmittance(march))

object LightConnection:
  /** Follows a shadow ray through interfaces and the like; false if another surface blocks it.
    *
    * @param opens   whether light passes `border`, a surface that it meets
    * @param crossed called at each interface, with the ray's direction
    * @param segment called for each segment up to a surface or the end; false if it lets no light
    *                through
    * @param aim     sets the ray from a point behind an interface to the light
    */
  inline def reaches(
      scene: Scene,
      ray: Ray,
      hit: Hit,
      border: ShadingPoint,
      inline opens: => Boolean,
      inline crossed: Vec3 => Unit,
      inline segment: => Boolean,
      inline aim: Vec3 => Unit
  ): Boolean =
    var going = true
    var arrives = true
    while going do
      going = scene.closest(ray, hit)
      if going then
        scene.surface(ray, hit, border)
        arrives = opens
      arrives = arrives && segment
      going = going && arrives
      if going then
        val direction = ray.direction
        crossed(direction)
        aim(border.offsetOrigin(direction))
    arrives

  /** End of a shadow ray, as a fraction of the distance to the light: the rounding error of the
    * difference of its end points, at most 2⁻²³ of its length, must not reach the light's own
    * surface. At grazing angles it ends sooner. Occluders closer to the light than that are lost.
    *
    * @param cosine of the angle to the light's normal; 0 if it has none
    */
  def shadowEnd(cosine: Float): Float = 1f - Math.min(1f - ShadowEnd, 5e-6f / cosine)

  /** The smallest of these fractions, which serves lights at any angle. */
  inline val ShadowEnd = 0.9999f

  /** End point of a shadow ray: offset from the point on the light, so that it misses the light. */
  def end(sample: LightSample): Vec3 =
    val target = sample.target
    ShadingPoint.offset(target.p, target.pError, target.n, -sample.wi)
