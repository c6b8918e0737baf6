package candela.integrators

import candela.geometry.Hit
import candela.guiding.PhotonField
import candela.lights.Light
import candela.manifold.Coverage
import candela.sampling.Discrete
import candela.scene.Scene

/** Which light manifold walks find: that which emitters send, by way of one or two surfaces that
  * mirror or refract it, to a path from the camera whose first event is specular too. No light path
  * can be connected to such a path. Immutable.
  *
  * Of delta lights they find all such light, which paths can't. Of area lights they find
  * it where photons arrive, which say where walks are to begin; there paths leave it out. So both
  * together find all of it once.
  *
  * @param maxDepth scattering events of a path, at most
  * @param isWalked by index of the light: is its light looked for?
  * @param seeds    photons that area lights have sent; null: walks look for delta lights
  * @param most     walks for the probability of a chain, at most: what fewer find is too dark
  * @param usual    light of a chain, before its probability is known: that of darker ones is found
  *   by few walks, in proportion
  * @param tally    counts what the walks save, if it is to be known
  */
final class Manifolds(
    scene: Scene,
    private[integrators] val maxDepth: Int,
    isWalked: Int => Boolean,
    private[integrators] val seeds: PhotonField | Null = null,
    private[integrators] val most: Int = Manifolds.MostWalks,
    usual: Float = 0f,
    private[integrators] val tally: WalkTally | Null = null
):
  /** Delta lights by power: the chance does not depend on the place, as they may be seen in
    * mirrors. Area lights are chosen apart, since the powers of both can't be compared.
    */
  private[integrators] val points: Discrete | Null = chosen(_.isDelta)
  private[integrators] val surfaces: Discrete | Null = chosen(_.asSurface != null)

  private def chosen(isOfKind: Light => Boolean): Discrete | Null =
    val powers = Array.tabulate(scene.lights.length): i =>
      val emitter = scene.lights(i)
      if isOfKind(emitter) && emitter.isCausticSource && isWalked(i) then
        Discrete.weight(emitter.power(scene.ball))
      else 0f
    if powers.exists(_ > 0f) then Discrete(powers) else null

  /** Is there nothing to find: no light that walks look for, or no caster? */
  def isEmpty: Boolean = points == null && surfaces == null || scene.casters.isEmpty

  /** Do the walks look for light at the vertex? */
  private[integrators] def suits(vertex: SurfaceVertex, path: PathHistory): Boolean =
    path.chain != Manifolds.NoWalks && path.depth > 1 && path.depth < maxDepth &&
      !vertex.bsdf.isSpecular

  /** Probability of walks for the probability of a chain of so much light. */
  private[integrators] def chance(light: Float): Float =
    if light < usual then light / usual else 1f

  /** Do they find what the path meets of an area light? */
  private[integrators] def finds(light: Int, path: PathHistory): Boolean =
    path.chain > Manifolds.Started && path.chain <= Manifolds.Longest && {
      val emitters = surfaces
      emitters != null && emitters.probability(light) > 0f
    }

  /** The path leaves the vertex by `vertex.bounce`: what they find of what it meets from here on.
    *
    * @param isLooked do they look for light of surfaces at the vertex?
    */
  private[integrators] def leave(
      vertex: SurfaceVertex,
      hit: Hit,
      path: PathHistory,
      coverage: Coverage,
      isLooked: Boolean
  ): Unit =
    val before = path.chain
    if before != Manifolds.NoWalks then
      if !vertex.bounce.isSpecular then
        path.chain =
          if path.depth == 1 then Manifolds.NoWalks
          else if isLooked then Manifolds.Started
          else Manifolds.Beyond
      else if before >= Manifolds.Started && before != Manifolds.Beyond then
        val goesOn = before < Manifolds.Longest &&
          coverage.covers(hit, vertex.at, vertex.bsdf, vertex.localWo)
        path.chain = if goesOn then before + 1 else Manifolds.Beyond

private[candela] object Manifolds:
  /** The path has met only specular surfaces since the camera. */
  inline val SpecularFromCamera = 0

  /** The path has just left a surface where walks look for light; the next numbers: it has met one
    * surface of chains since, or two.
    */
  inline val Started = 1
  inline val Longest = 3

  /** Walks find nothing of what the path meets, but may look for light at its next vertices. */
  inline val Beyond = 4

  /** No walks start from the path, nor find what it meets: light paths may reach it. */
  inline val NoWalks = -1

  inline val MostWalks = 100000

/** Counts what manifold walks save. Mutable, one per worker.
  *
  * @param emitters of the scene
  */
final class WalkTally(emitters: Int):
  /** Of each emitter, by how much second moments are below those of paths that meet it by
    * chance.
    */
  val saved: Array[Double] = new Array[Double](emitters)

  private var latest = 0.0

  /** Chains found, and their light before their probability is known. */
  var count = 0L
  var light = 0.0

  /** A walk has found a chain.
    *
    * @param light of the chain, but for its probability
    * @param walks the inverse of that
    * @param ratio of what a path finds that meets the emitter by chance, to `light`
    */
  private[integrators] def add(emitter: Int, light: Double, walks: Double, ratio: Double): Unit =
    val contribution = light * walks
    val saving = contribution * contribution * (Math.min(ratio / walks, WalkTally.MostRatio) - 1.0)
    if saving.isFinite then
      this.light += light
      count += 1
      saved(emitter) += saving
      latest += saving

  /** What was saved since the last call. */
  def take(): Double =
    val saving = latest
    latest = 0.0
    saving

object WalkTally:
  /** What one walk finds must not decide alone. */
  private inline val MostRatio = 1e6
