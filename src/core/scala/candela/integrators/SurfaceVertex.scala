package candela.integrators

import candela.bsdf.{Bounce, Bsdf, Bssrdf, Lambert}
import candela.color.Rgb
import candela.geometry.{Frame, Hit, Ray, ShadingPoint}
import candela.math.*
import candela.sampling.{Sampler, Warp}
import candela.scene.Scene

/** A vertex of a path on a surface. Directions point away from it, in world space unless a name
  * says local; `wo` is where the path came from. Mutable, one per path that is being traced.
  *
  * Order of use: [[hit]], then [[evaluate]] (or [[scatterBy]]), then the rest.
  */
class SurfaceVertex(scene: Scene):
  final val point: ShadingPoint = scene.newPoint()
  private val ownWo, ownLocalWo, departing, sided = MutableVec3()

  /** The direction that [[draw]] sampled. */
  final val bounce: Bounce = Bounce()
  private var scattering: Bsdf = SurfaceVertex.Black

  final def bsdf: Bsdf = scattering
  final def wo: MutableVec3 = ownWo
  final def localWo: MutableVec3 = ownLocalWo

  /** Is it a scattering event in a medium? */
  final var isInMedium: Boolean = false

  /** Normal for the choice of lights, on the side of `wo`; zero where light may come from both
    * sides, and in a medium.
    */
  final def lightNormal: MutableVec3 =
    if isInMedium || bsdf.isTransmissive then sided.set(Vec3.Zero)
    else
      val n = point.frame.n
      val isFront =
        if !scene.sidesByGeometry then localWo.z > 0f
        else ((wo dot point.geometricNormal) > 0f) == ((n dot point.geometricNormal) > 0f)
      if !isFront then sided.set(-n.x, -n.y, -n.z) else sided.set(n)
    sided

  /** Puts the vertex in a medium, whose phase function is `phase`. */
  final def scatterAt(p: Vec3, wo: Vec3, phase: Bsdf): Unit =
    isInMedium = true
    point.p = p
    point.pError = Vec3.Zero
    // The direction goes into the frame, into the sample and out again: its length would be cubed
    // at each event, and a rounding error grow to infinity within some twenty
    val unit = wo.normalized
    point.geometricNormal = unit
    point.areaLight = -1
    point.frame.set(Frame.fromZ(unit))
    scatterBy(phase, unit)

  /** Computes the surface geometry where `ray` hit it. */
  final def hit(ray: Ray, hit: Hit): Unit =
    isInMedium = false
    scene.surface(ray, hit, point)
    ownWo.set(-ray.dx, -ray.dy, -ray.dz)

  /** Only a border of media, without a BSDF? */
  final def isInterface: Boolean = scene.isInterface(point)

  /** Continues the ray in its direction, through an interface. */
  final def passThrough(ray: Ray): Unit = scene.passThrough(ray, point)

  /** Evaluates the material, which may turn the frame. */
  final def evaluate(regularized: Boolean = false): Unit =
    scatterBy(if regularized then scene.bsdf(point).regularized else scene.bsdf(point), wo)

  /** Replaces the BSDF. */
  final def scatterBy(bsdf: Bsdf): Unit = scattering = bsdf

  /** Replaces the BSDF and the direction that the path came from. */
  final def scatterBy(bsdf: Bsdf, wo: Vec3): Unit =
    scattering = bsdf
    ownWo.set(wo)
    point.frame.toLocal(wo, ownLocalWo)

  /** The BSDF for light from `wi` that a camera path receives. */
  final def received(wi: Vec3): Rgb = received(wi, point.frame.toLocal(wi))

  /** Likewise, if the local direction is known. */
  final def received(wi: Vec3, localWi: Vec3): Rgb =
    if isOpen(wi) then value(localWo, localWi) else Rgb.Black

  /** The BSDF for light that a light path sends on to `wi`. */
  final def sent(wi: Vec3): Rgb =
    if isOpen(wi) then value(point.frame.toLocal(wi), localWo) else Rgb.Black

  /** Solid-angle density with which the path continues to `wi`. */
  final def pdf(wi: Vec3): Float = localPdf(point.frame.toLocal(wi))

  /** Likewise, to a local direction. */
  final def localPdf(localWi: Vec3): Float = bsdf.pdf(localWo, localWi)

  /** Solid-angle density with which a path from `wi` would continue to `wo`. */
  final def reversePdf(wi: Vec3): Float = bsdf.pdf(point.frame.toLocal(wi), localWo)

  /** |cos| of the angle to the geometric normal; 1 in a medium. */
  final def cosine(w: Vec3): Float = if isInMedium then 1f else point.geometricNormal absDot w

  /** |cos| of the angle to the shading normal; 1 in a medium. */
  final def shadingCosine(w: Vec3): Float = if isInMedium then 1f else point.frame.n absDot w

  /** Does the local direction lie on the other side of the shading normal than `wo`? */
  final def crosses(localWi: Vec3): Boolean = localWi.z * ownLocalWo.z < 0f

  /** Does the bounce keep the path's direction? */
  final def isStraight: Boolean =
    bounce.isSpecular && (bounce.wi.toVec3 + ownLocalWo.toVec3).lengthSquared < 1e-10f

  /** False if the geometric normal separates `wi` from `wo`, and the BSDF scatters no light through
    * the surface, but in single directions.
    */
  final def isOpen(wi: Vec3): Boolean =
    !scene.sidesByGeometry || bsdf.scattersThrough ||
      ((wi dot point.geometricNormal) > 0f) == ((wo dot point.geometricNormal) > 0f)

  /** Of directions for which the surface [[isOpen]]. */
  private def value(wo: Vec3, wi: Vec3): Rgb =
    if !scene.sidesByGeometry || bsdf.scattersThrough || (wo.z > 0f) == (wi.z > 0f) then
      bsdf.f(wo, wi)
    else bsdf.reflectedAcross(wo, wi)

  /** Samples the BSDF into `bounce`. */
  final def draw(sampler: Sampler): Unit =
    val choice = sampler.next1D(matters = scattering.choosesLobes)
    sampler.next2D()
    draw(choice, sampler.x, sampler.y)

  /** Likewise, by these random numbers. */
  final def draw(choice: Float, x: Float, y: Float): Unit =
    scattering.draw(localWo, choice, x, y, bounce)

  /** Samples a direction into `bounce` with equal density, of both sides of the surface or of that
    * of `wo`.
    */
  final def drawUniformly(bothSides: Boolean, sampler: Sampler): Unit =
    sampler.next2D()
    val wi =
      if bothSides then Warp.uniformSphere(sampler.x, sampler.y)
      else
        val frame = Frame.fromZ(point.geometricNormal.facing(wo))
        frame.toWorld(Warp.uniformHemisphere(sampler.x, sampler.y))
    val localWi = point.frame.toLocal(wi)
    val pdf = if bothSides then 0.5f * InvTwoPi else InvTwoPi
    val weight = received(wi, localWi) * (Math.abs(localWi.z) / pdf)
    bounce.set(localWi, weight, pdf, isSpecular = false)

  /** How light travels beneath the surface, if `bounce` was refracted into it; null: straight. */
  final def beneath: Bssrdf | Null =
    if ownLocalWo.z * bounce.wi.z < 0f then scene.bssrdf(point) else null

  /** Sets the ray on its way in the direction of `bounce`.
    *
    * @return false if the surface is in the way: the path ends
    */
  final def spawnRay(ray: Ray): Boolean = spawnRay(ray, bounce.wi, bounce.isSpecular, bounce.eta)

  /** Likewise, to the local direction `localWi`. */
  final def spawnRay(ray: Ray, localWi: Vec3, isSpecular: Boolean, eta: Float): Boolean =
    val wi = departing
    point.frame.toWorld(localWi, wi)
    ray.set(point.offsetOrigin(wi), wi, Float.PositiveInfinity)
    scene.scattered(ray, point, wo, wi, isSpecular, eta)
    isSpecular || isOpen(wi)

private object SurfaceVertex:
  /** Before anything was hit. */
  private val Black: Bsdf = Lambert(Rgb.Black)
