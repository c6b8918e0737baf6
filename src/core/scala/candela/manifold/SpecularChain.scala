package candela.manifold

import candela.color.{MutableRgb, Rgb}
import candela.geometry.{Frame, Hit, Ray, ShadingPoint}
import candela.math.*
import candela.sampling.{RandomStream, Warp}
import candela.scene.{CasterPoint, Casters, Scene}

/** A chain of one or two surfaces that reflect or refract light on its way from an emitter to a
  * point `x`, found by a manifold walk. Mutable, one per worker.
  *
  * The walk moves the first vertex on its tangent plane, and traces the others from there, so that
  * all but the last obey the law of reflection or refraction. At the last one, the tangential part
  * of the direction to the emitter must be that of the direction of arrival, times the ratio of the
  * indices: Newton's method solves this equation of two dimensions.
  *
  * Sources: Hanika, Droske and Fascione, "Manifold Next Event Estimation", EGSR 2015; Zeltner,
  * Georgiev and Jakob, "Specular Manifold Sampling for Rendering High-Frequency Caustics and
  * Glints", SIGGRAPH 2020. Differentials: Igehy, "Tracing Ray Differentials", SIGGRAPH 1999.
  */
final class SpecularChain(scene: Scene):
  private val coverage = Coverage(scene)
  private val vertices = Array.fill(SpecularChain.Longest)(ChainVertex(scene, coverage))
  private val ray = Ray()
  private val hit = Hit()
  private val seed = CasterPoint()
  private var rays = 0L

  // The chain's ends
  private val x, xError, xNormal = MutableVec3()
  private val emitter = MutableVec3()
  private var isFar = false

  private var length = 0
  private var most = 1

  private val start = MutableVec3()

  // Newton's method: where the first vertex was, and the step from there
  private val base, stepA, stepB = MutableVec3()
  private var a, b = 0f
  private var error, tolerance = 0f

  // Differentials by the first vertex
  private val pA, pB, dA, dB, towards = MutableVec3()

  /** Solid angle at x of an area on the tangent plane of the first vertex. */
  private var seen = 0.0

  private val kept = MutableVec3()
  private var keptPattern = 0

  def raysTraced: Long = rays

  /** How many vertices the chain has. */
  def events: Int = length

  /** Direction at x. */
  def direction: MutableVec3 = vertices(0).wi

  /** Places the end `x` of all chains to come.
    *
    * @param most vertices at most
    */
  def begin(from: ShadingPoint, time: Float, most: Int): Unit =
    x.set(from.p)
    xError.set(from.pError)
    xNormal.set(from.geometricNormal)
    ray.time = time
    ray.differential.isKnown = false
    this.most = Math.min(most, SpecularChain.Longest)

  /** Places the emitter at a point, or infinitely far away in a direction. */
  def aim(place: Vec3, isDirection: Boolean): Unit =
    emitter.set(place)
    isFar = isDirection

  /** Walks from a point of a caster, or from that on the straight way to the emitter, which light
    * rays that are refracted are often close to; true if the walk has found a chain.
    */
  def find(random: RandomStream): Boolean =
    val isSeeded =
      if random.next() < SpecularChain.Straight then
        towardsEmitter(random)
        true
      else
        val choice = Casters.choice(random.next(), random.next())
        val isSampled = scene.casters.sample(choice, random.next(), random.next(), ray, seed)
        start.set(seed.p)
        isSampled
    isSeeded && plant(random) && walk()

  /** Likewise, from what is seen in a direction. */
  def findAlong(way: Vec3, random: RandomStream): Boolean =
    start.set(x + way * (if isFar then 1f else (emitter - x).length))
    plant(random) && walk()

  /** Starts in a direction near that of the emitter, at a distance of an even logarithm: the
    * closer, the more do waves send light to x.
    */
  private def towardsEmitter(random: RandomStream): Unit =
    val way = if isFar then emitter.toVec3 else emitter - x
    val around = Warp.uniformSphere(random.next(), random.next())
    val spread = exp(SpecularChain.Closest * random.next()) * way.length
    start.set(x + way + around * spread)

  /** Traces the seed, which chooses events. */
  private def plant(random: RandomStream): Boolean =
    length = 1
    meet(start) && vertices(0).choose(random.next()) && {
      if most > 1 then
        depart(vertices(0))
        val isLonger =
          vertices(1).isMet(ray, hit) && random.next() < SpecularChain.SecondVertexProbability &&
            vertices(1).choose(random.next())
        if isLonger then length = 2
      error = Float.PositiveInfinity
      differentiate(limit = Float.PositiveInfinity)
    }

  /** Traces the ray from x towards a point. */
  private def meet(p: Vec3): Boolean =
    val direction = (p - x).normalized
    ray.set(ShadingPoint.offset(x, xError, xNormal, direction), direction, Float.PositiveInfinity)
    rays += 1
    vertices(0).isMet(ray, hit)

  private def depart(from: ChainVertex): Unit =
    val wo = from.wo
    ray.set(from.at.offsetOrigin(wo), wo, Float.PositiveInfinity)
    rays += 1

  private def walk(): Boolean =
    var scale = 1f
    var left = SpecularChain.Steps
    while left > 0 && !(error < tolerance) && scale >= SpecularChain.Shortest do
      left -= 1
      scale = if step(scale) then Math.min(1f, 2f * scale) else 0.5f * scale
    error < tolerance && arrives

  /** Does light leave the last vertex on the side where the emitter is? */
  private def arrives: Boolean =
    val last = vertices(length - 1)
    (towards dot last.wo) > SpecularChain.Aligned

  /** Goes this part of Newton's step; false if it does not lead to a better chain. */
  private def step(scale: Float): Boolean =
    val to = base + stepA * (a * scale) + stepB * (b * scale)
    to.isFinite && meet(to) && vertices(0).take(vertices(0).isRefracted) && {
      var i = 1
      var goesOn = true
      while goesOn && i < length do
        depart(vertices(i - 1))
        val next = vertices(i)
        goesOn = next.isMet(ray, hit) && next.take(next.isRefracted)
        i += 1
      goesOn && differentiate(error)
    }

  /** Computes the error of the chain, and Newton's step, unless the error is above `limit`. */
  private def differentiate(limit: Float): Boolean =
    follow()
    val last = vertices(length - 1)
    val frame = last.at.frame
    val way = emitter - last.p
    val distance = way.length
    val to = if isFar then emitter.toVec3 else way * (1f / distance)
    val k = last.ratio
    val rest = to - last.wi * k
    val (s, t) = (frame.s dot rest, frame.t dot rest)
    val length2 = s * s + t * t
    if !(length2 < limit * limit) then false
    else
      error = sqrt(length2)
      towards.set(to)
      val nearness = if isFar then 0f else 1f / distance
      val p = last.p
      val reach = Math.max(Math.abs(p.x), Math.max(Math.abs(p.y), Math.abs(p.z)))
      val rounding = reach * nearness * SpecularChain.Rounding
      tolerance = Math.max(SpecularChain.Tolerance, rounding)
      val along = frame.n dot rest
      def change(p: Vec3, d: Vec3): Vec3 =
        (to * (to dot p) - p) * nearness - d * k - last.bend(p) * along
      val byA = change(pA, dA)
      val byB = change(pB, dB)
      val (sA, tA) = ((frame.s dot byA).toDouble, (frame.t dot byA).toDouble)
      val (sB, tB) = ((frame.s dot byB).toDouble, (frame.t dot byB).toDouble)
      val determinant = sA * tB - sB * tA
      val inverse = if determinant == 0.0 then 0.0 else 1.0 / determinant
      base.set(vertices(0).p)
      Frame.basis(vertices(0).side, stepA, stepB)
      a = ((sB * t - tB * s) * inverse).toFloat
      b = ((tA * s - sA * t) * inverse).toFloat
      true

  /** Computes the differentials at the last vertex by the place of the first. */
  private def follow(): Unit =
    val near = vertices(0)
    val d = near.wi
    val inverse = 1f / (near.p - x).length
    Frame.basis(near.side, pA, pB)
    dA.set((pA - d * (d dot pA)) * inverse)
    dB.set((pB - d * (d dot pB)) * inverse)
    seen = (d absDot near.side).toDouble * inverse * inverse
    var i = 1
    while i < length do
      val from = vertices(i - 1)
      val to = vertices(i)
      val way = (to.p - from.p).length
      go(from, to, way, pA, dA)
      go(from, to, way, pB, dB)
      i += 1

  /** Advances a differential of place and direction from one vertex to the next. */
  private def go(
      from: ChainVertex,
      to: ChainVertex,
      way: Float,
      p: MutableVec3,
      d: MutableVec3
  ): Unit =
    d.set(from.departure(d, from.bend(p)))
    val across = p + d * way
    val wo = from.wo
    p.set(across - wo * ((across dot to.side) / (wo dot to.side)))

  /** What the chain scatters: the product of its vertices. */
  def throughput(out: MutableRgb): Unit =
    out.set(Rgb.White)
    var i = 0
    while i < length do
      val bounce = vertices(i).bounce
      out.scale(bounce.weight)
      out.scale(bounce.pdf)
      i += 1

  /** Probability with which a path that comes to the chain follows it. */
  def probability: Double =
    val first = vertices(0).bounce.pdf.toDouble
    if length > 1 then first * vertices(1).bounce.pdf else first

  /** Has the throughput but a first component? */
  def isDispersive: Boolean =
    vertices(0).isDispersive || length > 1 && vertices(1).isDispersive

  /** Solid angle at x in which an area at the emitter is seen, which faces the light; or, if the
    * emitter is infinitely far away, a solid angle of its directions.
    */
  def spread: Double =
    val last = vertices(length - 1)
    val way = if isFar then 1f else (emitter - last.p).length
    def arrival(p: Vec3, d: Vec3): Vec3 =
      val turn = last.departure(d, last.bend(p))
      if isFar then turn else p + turn * way
    follow()
    val across = arrival(pA, dA) cross arrival(pB, dB)
    seen / Math.abs(across dot last.wo)

  /** The last vertex. */
  def end: MutableVec3 = vertices(length - 1).p

  /** Direction from the chain to the emitter. */
  def toEmitter: MutableVec3 = towards

  /** Traces the ray from the chain to the emitter: does it reach an area light there?
    *
    * @param light index of the emitter
    * @param at    where it is met
    */
  def reaches(light: Int, at: ShadingPoint): Boolean =
    val last = vertices(length - 1)
    val distance = (emitter - last.p).length
    leave(at) && at.areaLight == light &&
    (at.p - emitter).length < SpecularChain.DistanceTolerance * distance

  /** Likewise of an emitter that is none of the scene's surfaces. */
  def escapes(at: ShadingPoint): Boolean =
    val last = vertices(length - 1)
    val distance = if isFar then Float.PositiveInfinity else (emitter - last.p).length
    !leave(at) || (at.p - last.p).length > distance

  private def leave(at: ShadingPoint): Boolean =
    val last = vertices(length - 1)
    ray.set(last.at.offsetOrigin(towards), towards, Float.PositiveInfinity)
    rays += 1
    scene.closestBehindInterfaces(ray, hit, at)

  /** Keeps the chain for [[isSame]]. */
  def keep(): Unit =
    kept.set(direction)
    keptPattern = pattern

  /** Is the chain the one that was kept? */
  def isSame: Boolean =
    pattern == keptPattern && (kept - direction).lengthSquared < SpecularChain.DirectionTolerance

  private def pattern: Int =
    val last = if length > 1 && vertices(1).isRefracted then 2 else 0
    length * 4 + last + (if vertices(0).isRefracted then 1 else 0)

private[candela] object SpecularChain:
  private inline val Longest = 2

  /** Probability of a walk from the straight way to the emitter. */
  private inline val Straight = 0.5f

  /** Logarithm of the smallest distance from it, relative to that of the emitter. */
  private inline val Closest = -5f

  /** Probability of a second vertex, where there may be one. */
  private inline val SecondVertexProbability = 0.75f

  /** Of Newton's method. */
  private inline val Steps = 20
  private inline val Shortest = 0.06f

  /** Largest error of a chain, as a sine: above the rounding of traced rays; and that of places,
    * relative to the distance to the emitter.
    */
  private inline val Tolerance = 1e-5f
  private inline val Rounding = 2.5e-7f

  /** Cosine of the angle between the direction of departure and that to the emitter: others are on
    * the wrong side of the surface.
    */
  private inline val Aligned = 0.9999f

  /** Two walks have found the same chain if the squared distance of their directions is less. */
  private inline val DirectionTolerance = 1e-7f

  /** A ray may meet the emitter this far from the expected point, relative to the distance of
    * both.
    */
  private inline val DistanceTolerance = 1e-3f
