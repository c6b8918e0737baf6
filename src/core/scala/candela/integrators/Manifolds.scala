package candela.integrators

import candela.sampling.Discrete
import candela.scene.Scene

/** Which light manifold walks find: that which lamps without extent send, by way of one or two
  * surfaces that mirror or refract it, to a surface which the camera sees off or through specular
  * surfaces only. Neither paths nor light paths find it. Immutable.
  *
  * Lamps with extent are left to paths: where solutions are many, as under waves, walks to these
  * cost more than they bring.
  *
  * @param maxDepth scattering events of a path, at most
  */
final class Manifolds(scene: Scene, private[integrators] val maxDepth: Int):
  private val powers: Array[Float] = scene.lights.toArray.map: light =>
    if light.isCausticSource && light.isDelta then Discrete.weight(light.power(scene.ball)) else 0f

  /** Lamps by power: the chance does not depend on the place, as they may be seen in mirrors. */
  private[integrators] val lamps: Discrete | Null =
    if powers.exists(_ > 0f) then Discrete(powers) else null

  /** Are there lamps and surfaces of the kind? */
  def isEmpty: Boolean = lamps == null || scene.casters.isEmpty

  /** Do the walks look for light at the vertex? */
  private[integrators] def suits(vertex: SurfaceVertex, path: PathState): Boolean =
    path.chain == Manifolds.Seen && path.depth > 1 && path.depth < maxDepth &&
      !vertex.bsdf.isSpecular

  /** The path leaves the vertex by `vertex.bounce`. */
  private[integrators] def leave(vertex: SurfaceVertex, path: PathState): Unit =
    if !vertex.bounce.isSpecular then path.chain = Manifolds.Other

private[candela] object Manifolds:
  /** The camera sees the path by specular surfaces only. */
  inline val Seen = 0
  inline val Other = -1
