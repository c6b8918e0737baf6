package candela.bench.robustness

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*

/** Where a shape is. */
enum Place(val words: String):
  /** Of size 1e-6 to 1e6, some sizes from the origin. */
  case Near extends Place("of any scale")

  /** A million times as far from the origin as it is small, at most. */
  case Far extends Place("far from the origin")

  /** Of size 1e6, with the origin on it: a ground. */
  case Ground extends Place("as a ground, 1e6 wide")
  case Instanced extends Place("in an instance")
  case Moving extends Place("in a moving instance")

/** Rays that land on a shape alone in the world and leave it again: they must not meet it. */
final class SpawnedRays(kind: Kind, place: Place, trials: Trials):
  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint()
  private val draws = trials.draws(kind.name.hashCode + place.ordinal)
  private var size = 1f

  private def uniform(s: Double) = Transform.scale(s, s, s).get
  private def anyPlace(distance: Float) =
    draws.translation(size * distance) * draws.rotation() * draws.stretch()

  private def target(): Target = place match
    case Place.Near =>
      size = draws.magnitude(1e-6, 1e6)
      kind.create(draws, anyPlace(draws.magnitude(1e-3, 10)), size, None)
    case Place.Far =>
      size = draws.magnitude(1e-3, 1e3)
      kind.create(draws, anyPlace(draws.magnitude(1e2, 1e5)), size, None)
    case Place.Ground =>
      size = 1e6f
      onOrigin()
    case Place.Instanced =>
      size = draws.magnitude(1e-4, 1e4)
      val outside = anyPlace(draws.magnitude(1e-2, 1e3)) * uniform(size)
      val inside = draws.magnitude(1e-3, 1e3)
      kind.create(
        draws,
        uniform(1 / inside) * draws.rotation(),
        inside,
        Some(Still(outside))
      )
    case Place.Moving =>
      size = draws.magnitude(1e-3, 1e3)
      val start = anyPlace(draws.magnitude(1e-2, 1e2)) * uniform(size)
      val end = draws.translation(size) * draws.rotation() * start
      val motion = Interpolation(start, end, 0f, 1f, shortest = true)
      kind.create(draws, Transform.Identity, 1f, Some(motion))

  /** Finds a point of a shape and makes it again, moved by that. */
  private def onOrigin(): Target =
    val turned = draws.rotation()
    val seed = draws.below(1 << 20)
    val first = kind.create(Draws(seed), turned, size, None)
    if land(first, 0.4f) then
      kind.create(Draws(seed), Transform.translate(-at.p.x, -at.p.y, -at.p.z) * turned, size, None)
    else onOrigin()

  /** Aims at the target, and answers whether the hit's geometry is now in `at`. */
  private def land(target: Target, spread: Float): Boolean =
    val box = target.bounds
    val o = box.center + draws.direction() * (box.radius * draws.between(0.1f, 4f))
    val inBox = draws.vec(-spread, spread)
    val goal = box.center +
      Vec3(inBox.x * box.extent.x, inBox.y * box.extent.y, inBox.z * box.extent.z)
    trace(target, o, goal)

  private def trace(target: Target, o: Vec3, goal: Vec3): Boolean =
    ray.time = draws.unit()
    ray.set(o, (goal - o).normalized, Float.PositiveInfinity)
    val hasHit = target.closest(ray, hit)
    if hasHit then target.fill(ray, hit, at)
    hasHit

  /** Close to the origin, at any scale. */
  private def landOnGround(target: Target): Boolean =
    val goal = draws.direction() * draws.magnitude(1e-6, 1e3)
    trace(target, goal + draws.direction() * draws.magnitude(1e-2, 1e3), goal)

  /** @throws IllegalStateException if rays miss the shapes nearly always */
  def tally(): Tally =
    var (landed, faults, tries) = (0L, 0L, 0L)
    var first = Option.empty[String]
    while landed < trials.count do
      val t = target()
      var k = 0
      while k < SpawnedRays.PerShape do
        if place == Place.Ground && landOnGround(t) || place != Place.Ground && land(t, 0.4f) then
          val fault = spawnFault(t)
          landed += 1
          if fault.nonEmpty then
            faults += 1
            if first.isEmpty then first = Some(fault)
        k += 1
      tries += k
      if tries > 1000 * (trials.count + 100) then
        throw IllegalStateException(s"${kind.name}: only $landed hits in $tries tries")
    Tally(landed, faults, first)

  /** Spawns a ray at `at`; returns what is wrong with it. */
  private def spawnFault(target: Target): String =
    val n = at.geometricNormal
    val p = at.p
    if !(n.isFinite && Math.abs(n.length - 1f) < 1e-5f && p.isFinite) then s"point $p, normal $n"
    else
      val d = kind.leaving match
        case Leaving.Anywhere => draws.direction()
        case _ => draws.above(n)
      val isSteep = kind.leaving == Leaving.Steeply
      if isSteep && (d dot n) <= 0.1f then Tally.Sound
      else
        ray.set(at.offsetOrigin(d), d, if isSteep then 1e-4f * size else Float.PositiveInfinity)
        if target.isHit(ray, hit) then
          s"at $p (error ${at.pError}) normal $n direction $d size $size"
        else Tally.Sound

object SpawnedRays:
  /** Rays that are aimed at each shape. */
  private final val PerShape = 100
