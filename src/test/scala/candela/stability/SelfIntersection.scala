package candela.stability

import candela.bench.robustness.{Kind, Place, SpawnedRays}

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
      )(trials => Checks.holds(SpawnedRays(kind, place, trials).tally()))
    )

class SelfIntersectionSuite extends GroupSuite(SelfIntersection)
