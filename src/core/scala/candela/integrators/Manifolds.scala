package candela.integrators

import candela.geometry.Hit
import candela.manifold.Coverage
import candela.sampling.Discrete
import candela.scene.Scene

/** Which light manifold walks alone find: that which lamps send, by way of one or two surfaces that
  * mirror or refract it, to a surface which the camera sees off or through such surfaces only.
  * Immutable.
  *
  * Paths leave out what the walks find, so that both together find all of it once.
  *
  * @param maxDepth   scattering events of a path, at most
  * @param ofSurfaces light of surfaces, which paths find, too, if the walks don't
  * @param ofPoints   light of lamps without extent, which paths cannot find
  */
final class Manifolds(
    scene: Scene,
    private[integrators] val maxDepth: Int,
    ofSurfaces: Boolean,
    ofPoints: Boolean
):
  private val powers: Array[Float] = Array.tabulate(scene.lights.length): i =>
    val light = scene.lights(i)
    val isFound = if light.isDelta then ofPoints else ofSurfaces && light.asSurface != null
    if light.isCausticSource && isFound then Discrete.weight(light.power(scene.ball)) else 0f

  /** Lamps by power: the chance does not depend on the place, as they may be seen in mirrors. */
  private[integrators] val lamps: Discrete | Null =
    if powers.exists(_ > 0f) then Discrete(powers) else null

  /** Are there lamps and surfaces of the kind? */
  def isEmpty: Boolean = lamps == null || scene.casters.isEmpty

  /** Do the walks look for light at the vertex? */
  private[integrators] def suits(vertex: SurfaceVertex, path: PathState): Boolean =
    path.chain == Manifolds.Seen && path.depth > 1 && path.depth < maxDepth &&
      !vertex.bsdf.isSpecular

  /** Do they find what a path of the kind `chain` meets at the lamp? */
  private[integrators] def finds(light: Int, path: PathState): Boolean =
    path.chain > Manifolds.Started && powers(light) > 0f

  /** The path leaves the vertex by `vertex.bounce`: what it may find from here on. */
  private[integrators] def leave(
      vertex: SurfaceVertex,
      hit: Hit,
      path: PathState,
      coverage: Coverage
  ): Unit =
    val before = path.chain
    if !vertex.bounce.isSpecular then
      path.chain =
        if before == Manifolds.Seen && path.depth > 1 then Manifolds.Started else Manifolds.Other
    else if before >= Manifolds.Started then
      val goesOn = before < Manifolds.Longest &&
        coverage.covers(hit, vertex.at, vertex.bsdf, vertex.localWo)
      path.chain = if goesOn then before + 1 else Manifolds.Other

private[candela] object Manifolds:
  /** The camera sees the path by specular surfaces only. */
  inline val Seen = 0

  /** The path has just left the surface that the camera sees so; the next numbers: it has met one
    * surface of chains since, or two.
    */
  inline val Started = 1
  inline val Longest = 3
  inline val Other = -1
