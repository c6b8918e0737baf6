package candela.manifold

import candela.bsdf.{Bounce, Bsdf, Lambert}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.scene.Scene

/** A point of a chain, where light is reflected or refracted. Mutable, one per worker and place in
  * the chain.
  */
private[manifold] final class ChainVertex(scene: Scene, coverage: Coverage):
  val at: ShadingPoint = scene.newPoint()
  private val bent = ShadingPoint(wantsPartials = true, always = true)
  private val beside = scene.newPoint()
  private val localWo = MutableVec3()
  private val byU, byV = MutableVec3()
  private var bsdf: Bsdf = ChainVertex.Black

  /** What the present event samples; its weight times its pdf is what it scatters. */
  val bounce: Bounce = Bounce()

  /** Direction in which light paths' opposites arrive, and that in which they leave. */
  val wi, wo: MutableVec3 = MutableVec3()

  /** Is the present event a refraction? */
  var isRefracted: Boolean = false

  def isDispersive: Boolean = bsdf.isDispersive

  /** The index on the near side over that on the far side; 1 for a reflection. */
  def ratio: Float = if isRefracted then 1f / bounce.eta else 1f

  def n: MutableVec3 = at.frame.n
  def side: MutableVec3 = at.geometricNormal
  def p: MutableVec3 = at.p

  /** Traces the ray to the next surface; false if that is none of which chains consist. */
  def isMet(ray: Ray, hit: Hit): Boolean =
    scene.closestBehindInterfaces(ray, hit, at) && {
      wi.set(ray.dx, ray.dy, ray.dz)
      scene.bend(ray, hit, bent)
      bsdf = scene.bsdf(at)
      at.frame.toLocal(-wi, localWo)
      val isCovered = coverage.covers(hit, at, bsdf, localWo)
      if isCovered then curve(ray, hit)
      isCovered
    }

  /** Computes how the shading normal turns. */
  private def curve(ray: Ray, hit: Hit): Unit =
    val isPlain = (at.frame.n - bent.frame.n).lengthSquared < ChainVertex.NormalTolerance
    if isPlain || !scene.isTriangle(hit) then
      byU.set(bent.dndu)
      byV.set(bent.dndv)
    else
      val step = ChainVertex.Step
      byU.set(turned(ray, hit, step, 0.0))
      byV.set(turned(ray, hit, 0.0, step))

  /** Derivative of a perturbed normal, by differences. */
  private def turned(ray: Ray, hit: Hit, du: Double, dv: Double): Vec3 =
    val ahead = normalBeside(ray, hit, du, dv)
    val behind = normalBeside(ray, hit, -du, -dv)
    (ahead - behind) * (0.5 / (du + dv)).toFloat

  private def normalBeside(ray: Ray, hit: Hit, du: Double, dv: Double): Vec3 =
    val (u, v) = (hit.u, hit.v)
    hit.u = u + du
    hit.v = v + dv
    scene.surface(ray, hit, beside)
    val _ = scene.bsdf(beside)
    hit.u = u
    hit.v = v
    beside.frame.n.toVec3.facing(at.frame.n)

  /** How the shading normal turns along the tangent vector `along`. */
  def bend(along: Vec3): Vec3 =
    val u = bent.dpdu
    val v = bent.dpdv
    val uu = (u dot u).toDouble
    val uv = (u dot v).toDouble
    val vv = (v dot v).toDouble
    val determinant = uu * vv - uv * uv
    if !(determinant > 0.0) then Vec3.Zero
    else
      val a = (along dot u).toDouble
      val b = (along dot v).toDouble
      val s = ((vv * a - uv * b) / determinant).toFloat
      val t = ((uu * b - uv * a) / determinant).toFloat
      byU * s + byV * t

  /** Takes the event that this number chooses; false if there is none. */
  def choose(u: Float): Boolean =
    draw(u)
    bounce.isSpecular && !bounce.weight.isBlack && {
      isRefracted = bounce.wi.z * localWo.z < 0f
      true
    }

  /** Takes a reflection or a refraction; false if there is none. */
  def take(refraction: Boolean): Boolean =
    def isRight = bounce.isSpecular && (bounce.wi.z * localWo.z < 0f) == refraction
    isRefracted = refraction
    draw(if refraction then OneMinusEpsilon else 0f)
    if !isRight then draw(if refraction then 0f else OneMinusEpsilon)
    isRight

  private def draw(choice: Float): Unit =
    bsdf.draw(localWo, choice, 0.5f, 0.5f, bounce)
    at.frame.toWorld(bounce.wi, wo)

  /** How the direction of departure turns with that of arrival, by `turn`, and the normal, by `dn`.
    */
  def departure(turn: Vec3, dn: Vec3): Vec3 =
    val m = wi dot n
    val dm = (turn dot n) + (wi dot dn)
    if !isRefracted then turn - (n * dm + dn * m) * 2f
    else
      val k = ratio
      val t = wo dot n
      val dt = k * k * m * dm / t
      turn * k + n * (dt - k * dm) + dn * (t - k * m)

private object ChainVertex:
  private val Black: Bsdf = Lambert.Black

  /** Normals with a smaller squared distance are the same: no texture bends them. */
  private inline val NormalTolerance = 1e-12f

  /** In barycentric weights: beyond the rounding of differences of heights, within most texels. */
  private inline val Step = 5e-3
