package candela.stability

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.Draws
import Checks.assert

/** No ray that leaves a surface meets the same surface where it can't.
  *
  * On paper: the point of a hit lies within its error box of the true surface, and the ray starts
  * outside of that box on the side it goes to. A ray that leaves a plane, or a convex surface
  * outwards, then never comes back, so that not one in 10⁷ may. A saddle may be met again where it
  * curves up: that takes some tenths of its size, if the ray is steep. A curve faces every ray, and
  * is left by a width at least.
  */
object SelfIntersection extends Group(
      for
        kind <- Kind.all
        place <- Place.values.toSeq
      yield Case.sliced(
        s"a ${kind.name} ${place.words} is not met again",
        kind.quick,
        10_000_000L,
        s"rays spawned on a ${kind.name}"
      )(trials => SpawnedRays(kind, place, trials).check())
    )

class SelfIntersectionSuite extends GroupSuite(SelfIntersection)

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

private final class SpawnedRays(kind: Kind, place: Place, trials: Trials):
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
      kind.make(draws, anyPlace(draws.magnitude(1e-3, 10)), size, None)
    case Place.Far =>
      size = draws.magnitude(1e-3, 1e3)
      kind.make(draws, anyPlace(draws.magnitude(1e2, 1e5)), size, None)
    case Place.Ground =>
      size = 1e6f
      onOrigin()
    case Place.Instanced =>
      size = draws.magnitude(1e-4, 1e4)
      val outside = anyPlace(draws.magnitude(1e-2, 1e3)) * uniform(size)
      val inside = draws.magnitude(1e-3, 1e3)
      kind.make(
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
      kind.make(draws, Transform.Identity, 1f, Some(motion))

  /** Finds a point of a shape and makes it again, moved by that. */
  private def onOrigin(): Target =
    val turned = draws.rotation()
    val seed = draws.below(1 << 20)
    val first = kind.make(Draws(seed), turned, size, None)
    if land(first, 0.4f) then
      kind.make(Draws(seed), Transform.translate(-at.p.x, -at.p.y, -at.p.z) * turned, size, None)
    else onOrigin()

  /** Aims at the target, and answers whether the hit's geometry is now in `at`. */
  private def land(target: Target, spread: Float): Boolean =
    val box = target.bounds
    val o = box.center + draws.direction() * (box.radius * draws.between(0.1f, 4f))
    val inBox = draws.vec(-spread, spread)
    val goal = box.center +
      Vec3(inBox.x * box.extent.x, inBox.y * box.extent.y, inBox.z * box.extent.z)
    meet(target, o, goal)

  private def meet(target: Target, o: Vec3, goal: Vec3): Boolean =
    ray.time = draws.unit()
    ray.set(o, (goal - o).normalized, Float.PositiveInfinity)
    val found = target.closest(ray, hit)
    if found then target.fill(ray, hit, at)
    found

  /** Close to the origin, at any scale. */
  private def landOnGround(target: Target): Boolean =
    val goal = draws.direction() * draws.magnitude(1e-6, 1e3)
    meet(target, goal + draws.direction() * draws.magnitude(1e-2, 1e3), goal)

  def check(): Unit =
    val count = trials.count
    var spawned = 0L
    var tries = 0L
    while spawned < count do
      val t = target()
      var k = 0
      while k < 100 do
        if place == Place.Ground && landOnGround(t) || place != Place.Ground && land(t, 0.4f) then
          leave(t)
          spawned += 1
        tries += 1
        k += 1
      assert(tries < 1000 * (count + 100), s"only $spawned hits in $tries tries"): Unit

  private def leave(target: Target): Unit =
    val n = at.geometricNormal
    val p = at.p
    assert(n.isFinite && Math.abs(n.length - 1f) < 1e-5f && p.isFinite, s"$p $n")
    val d = kind.leaving match
      case Leaving.Anywhere => draws.direction()
      case _ => draws.above(n)
    val origin = at.offsetOrigin(d)
    ray.set(origin, d, Float.PositiveInfinity)
    def words = s"at $p (error ${at.pError}) normal $n direction $d size $size"
    kind.leaving match
      case Leaving.Steeply =>
        if (d dot n) > 0.1f then
          ray.set(origin, d, 1e-4f * size)
          assert(!target.isHit(ray, hit), words): Unit
      case _ => assert(!target.isHit(ray, hit), words): Unit
