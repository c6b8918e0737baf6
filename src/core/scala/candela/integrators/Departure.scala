package candela.integrators

import candela.geometry.{Ray, RayDifferential}
import candela.math.*

/** A ray, and the vertex at which its direction was sampled. Mutable. */
private[integrators] final class Departure:
  private val p, n, origin, direction = MutableVec3()
  private val differential = RayDifferential()

  def set(lastP: Vec3, lastN: Vec3, ray: Ray): Unit =
    p.set(lastP)
    n.set(lastN)
    origin.set(ray.origin)
    direction.set(ray.direction)
    if ray.differential.isKnown then differential.copy(ray.differential)
    else differential.isKnown = false

  def restore(lastP: MutableVec3, lastN: MutableVec3, ray: Ray): Unit =
    lastP.set(p)
    lastN.set(n)
    ray.set(origin, direction, Float.PositiveInfinity)
    if differential.isKnown then ray.differential.copy(differential)
    else ray.differential.isKnown = false
