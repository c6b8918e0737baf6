package candela.aov

import candela.color.{ColorBasis, Rgb}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.scene.Scene

/** The first surface of a camera ray, be it an interface or a hidden light; all its properties are
  * 0 if there is none. In world space; v is 1 at the bottom of images, where textures have 0.
  * Mutable, one per worker.
  *
  * @param origin of the scene, in its world
  * @param basis  of the scene's colours
  */
final class FirstHit(scene: Scene, origin: Position, basis: ColorBasis):
  private val ray = Ray()
  private val hit = Hit()
  private val point: ShadingPoint = scene.newPoint(always = true)
  private var isThere = false
  private var reflectance = Rgb.Black
  private var distance = 0f

  def copy(): FirstHit = FirstHit(scene, origin, basis)

  /** Traces a camera ray; leaves the ray unchanged. */
  def trace(from: Ray): Unit =
    ray.set(from.origin, from.direction, from.tMax)
    ray.time = from.time
    isThere = scene.closest(ray, hit)
    if isThere then
      scene.surface(ray, hit, point)
      distance = (point.p - from.origin).length
      reflectance =
        if scene.isInterface(point) then Rgb.Black
        else
          val bsdf = scene.bsdf(point) // which turns the shading frame
          bsdf.diffuseReflectance(point.frame.toLocal(-from.direction))

  private def number(x: Float): Float = if isThere then x else 0f
  private def vector(v: Vec3): Vec3 = if isThere then v else Vec3.Zero

  def depth: Float = number(distance)
  def position: Vec3 =
    def sum(x: Float, of: Double) = (x + of).toFloat
    vector(Vec3(sum(point.p.x, origin.x), sum(point.p.y, origin.y), sum(point.p.z, origin.z)))
  def u: Float = number(point.u)
  def v: Float = number(1f - point.v)

  /** Unit normals on the surface's outside. */
  def geometricNormal: Vec3 = vector(point.geometricNormal)
  def shadingNormal: Vec3 = vector(point.frame.n)

  /** Partial derivatives of the position by `u` and `v`; 0 unless the scene has them. */
  def dpdu: Vec3 = vector(point.dpdu)
  def dpdv: Vec3 = vector(-point.dpdv)

  /** As of [[candela.bsdf.Bsdf]], in linear sRGB. */
  def diffuseReflectance: Rgb = if isThere then basis.toSrgb(reflectance) else Rgb.Black
