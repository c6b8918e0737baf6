package candela.film

import candela.bsdf.Bsdf
import candela.color.{ColorBasis, Rgb}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.scene.Scene

/** The first visible surface of a camera ray, source of the AOVs with any integrator. Properties
  * are computed on demand. Mutable, one per worker.
  *
  * @param output transform from world space to that of the AOVs, at the time of a ray
  * @param basis  of the scene's colours
  */
final class VisibleSurface(val scene: Scene, output: Motion, basis: ColorBasis):
  private val ray = Ray()
  private val map = new Array[Double](Motion.Work)
  private var wo = Vec3.Zero
  private var bsdf: Bsdf | Null = null
  private var isHit = false
  private var distance = 0f

  /** The intersection, in world space. */
  val hit: Hit = Hit()
  val at: ShadingPoint = scene.newPoint()

  def copy(): VisibleSurface = VisibleSurface(scene, output, basis)

  /** Traces a camera ray through interfaces; leaves the ray unchanged. */
  def look(from: Ray): Unit =
    ray.set(from.origin, from.direction, Float.PositiveInfinity)
    ray.time = from.time
    ray.differential.copy(from.differential)
    isHit = scene.closestBehindInterfaces(ray, hit, at)
    if isHit then record(from, scene.bsdf(at))

  /** Records the hit in `at`. */
  private[film] def record(from: Ray, scattering: Bsdf): Unit =
    isHit = true
    bsdf = scattering
    wo = -from.direction
    distance = (at.p - from.origin).length
    output.write(from.time, map, 0)

  /** False if the ray missed; all other properties are then stale. */
  def isThere: Boolean = isHit

  def p: Vec3 = vector(at.p) + Vec3(map(3).toFloat, map(7).toFloat, map(11).toFloat)

  /** Unit normals facing the ray origin. */
  def n: Vec3 = normal(at.geometricNormal.facing(wo))
  def shadingNormal: Vec3 = normal(at.frame.n.facing(wo))

  /** Change of z to the next sample to the right, and below. */
  def dzdx: Float = if at.wantsPartials then vector(at.dpdx).z else 0f
  def dzdy: Float = if at.wantsPartials then vector(at.dpdy).z else 0f

  /** Distance from the ray origin, in scene units. */
  def depth: Float = distance

  /** Hemispherical-directional reflectance towards the camera, in linear sRGB. */
  def albedo: Rgb =
    val scattering = bsdf
    if scattering == null then Rgb.Black
    else
      val local = at.frame.toLocal(wo)
      var sum = Rgb.Black
      var i = 0
      while i < VisibleSurface.Samples do
        val k = 3 * i
        val points = VisibleSurface.points
        sum += scattering.sample(local, points(k), points(k + 1), points(k + 2)).weight
        i += 1
      basis.toSrgb(sum * (1f / VisibleSurface.Samples))

  private def vector(v: Vec3): Vec3 = Vec3(
    (map(0) * v.x + map(1) * v.y + map(2) * v.z).toFloat,
    (map(4) * v.x + map(5) * v.y + map(6) * v.z).toFloat,
    (map(8) * v.x + map(9) * v.y + map(10) * v.z).toFloat
  )

  /** Transforms by the transposed inverse. */
  private def normal(n: Vec3): Vec3 = Vec3(
    (map(12) * n.x + map(16) * n.y + map(20) * n.z).toFloat,
    (map(13) * n.x + map(17) * n.y + map(21) * n.z).toFloat,
    (map(14) * n.x + map(18) * n.y + map(22) * n.z).toFloat
  ).normalized

object VisibleSurface:
  /** Number of BSDF samples, as in pbrt-v4. */
  private val Samples = 16

  /** Quasi-random points of the unit cube, the same for every surface, so that the albedo has no
    * noise.
    *
    * Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: multiples of
    * powers of the root of x⁴ = x + 1.
    */
  private val points: Array[Float] =
    val root = 1.2207440846057596
    Array.tabulate(3 * Samples): i =>
      val step = Math.pow(root, -(i % 3 + 1.0))
      val x = 0.5 + (i / 3 + 1) * step
      (x - Math.floor(x)).toFloat
