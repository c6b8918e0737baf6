package candela.integrators

import candela.color.{ColorBasis, Rgb}
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.scene.Scene

/** What a film may want to know of the surface that a camera ray meets first; mutable, one per
  * worker. Vectors are in the space that the probe was made for.
  */
final class VisibleSurface:
  /** False if the ray met nothing; all else is then old. */
  var isThere = false
  var p, n, shadingNormal: Vec3 = Vec3.Zero
  var u, v = 0f

  /** How z changes to the next sample to the right, and below. */
  var dzdx, dzdy = 0f

  /** From where the ray began, in scene units. */
  var depth = 0f

  /** Part of the light that is scattered towards the eye under even light, in linear sRGB. */
  var albedo: Rgb = Rgb.Black

/** Looks along camera rays for the layers of an image, whatever integrator finds the light.
  *
  * @param output     from world space to that of the layers, at the time of a ray
  * @param basis      of the scene's colours
  * @param hasAlbedo  is the albedo wanted? It takes most of the time
  */
final class SurfaceProbe(scene: Scene, output: Motion, basis: ColorBasis, hasAlbedo: Boolean):
  private val ray = Ray()
  private val hit = Hit()
  private val at = scene.newPoint()
  private val map = new Array[Double](Motion.Work)
  val seen: VisibleSurface = VisibleSurface()

  def copy(): SurfaceProbe = SurfaceProbe(scene, output, basis, hasAlbedo)

  /** Fills in `seen` with what the camera ray meets behind interfaces; leaves the ray alone. */
  def look(from: Ray): Unit =
    ray.set(from.origin, from.direction, Float.PositiveInfinity)
    ray.time = from.time
    ray.differential.copy(from.differential)
    var meets = scene.closest(ray, hit)
    if meets then scene.surface(ray, hit, at)
    while meets && scene.isInterface(at) do
      ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
      scene.passed(ray)
      meets = scene.closest(ray, hit)
      if meets then scene.surface(ray, hit, at)
    seen.isThere = meets
    if meets then record(from.origin, -from.direction)

  private def record(origin: Vec3, wo: Vec3): Unit =
    val bsdf = scene.bsdf(at)
    output.write(ray.time, map, 0)
    seen.depth = (at.p - origin).length
    seen.p = vector(at.p) + Vec3(map(3).toFloat, map(7).toFloat, map(11).toFloat)
    seen.n = normal(at.geometricNormal.facing(wo))
    seen.shadingNormal = normal(at.frame.n.facing(wo))
    seen.u = at.u
    seen.v = at.v
    if at.wantsPartials then
      seen.dzdx = vector(at.dpdx).z
      seen.dzdy = vector(at.dpdy).z
    if hasAlbedo then
      val local = at.frame.toLocal(wo)
      var sum = Rgb.Black
      var i = 0
      while i < SurfaceProbe.Samples do
        val k = 3 * i
        val points = SurfaceProbe.points
        sum += bsdf.sample(local, points(k), points(k + 1), points(k + 2)).weight
        i += 1
      seen.albedo = basis.toSrgb(sum * (1f / SurfaceProbe.Samples))

  private def vector(v: Vec3): Vec3 = Vec3(
    (map(0) * v.x + map(1) * v.y + map(2) * v.z).toFloat,
    (map(4) * v.x + map(5) * v.y + map(6) * v.z).toFloat,
    (map(8) * v.x + map(9) * v.y + map(10) * v.z).toFloat
  )

  /** By the transposed inverse. */
  private def normal(n: Vec3): Vec3 = Vec3(
    (map(12) * n.x + map(16) * n.y + map(20) * n.z).toFloat,
    (map(13) * n.x + map(17) * n.y + map(21) * n.z).toFloat,
    (map(14) * n.x + map(18) * n.y + map(22) * n.z).toFloat
  ).normalized

object SurfaceProbe:
  /** As many as pbrt-v4 takes. */
  private val Samples = 16

  /** Points of the unit cube that lie evenly, the same for every surface: so an albedo has no
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
