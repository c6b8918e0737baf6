package candela.integrators

import candela.geometry.{Ray, RayDifferential}
import candela.math.*

/** A copy of a ray that has left a vertex. Mutable. */
private[integrators] final class Departure:
  private val origin, direction = MutableVec3()
  private val differential = RayDifferential()

  def set(ray: Ray): Unit =
    origin.set(ray.origin)
    direction.set(ray.direction)
    if ray.differential.isKnown then differential.copy(ray.differential)
    else differential.isKnown = false

  def restore(ray: Ray): Unit =
    ray.set(origin, direction, Float.PositiveInfinity)
    if differential.isKnown then ray.differential.copy(differential)
    else ray.differential.isKnown = false
