package candela.integrators

/** What [[PathTechniques]] know of a path: beside its state, what they remember themselves.
  * Mutable; each branch that waits has a copy.
  */
private[candela] final class PathHistory(path: PathState):
  export path.{carried, depth, isAlone, lastN, lastP}

  /** Has the path been scattered other than by specular surfaces? */
  var anyNonSpecularBounces: Boolean = false

  /** As long as a light path may have made the path: the density with which it would have come to
    * the vertex by the path's own; else 0. See [[CausticWeights]].
    */
  var densityRatio: Double = 0.0

  /** Likewise at an emitter that the ray may meet, as far as it is known before: of light paths
    * that begin at the last vertex, a caster, and of those that begin at the emitter.
    */
  var casterRatio, emitterRatio: Double = 0.0

  /** The solid-angle density of the current direction, without guiding, where one of the last two
    * is above 0; 0: it is specular.
    */
  var bsdfPdf: Float = 0f

  /** What manifold walks may look for from here, or what is left to photons: a number of
    * [[Manifolds]] or of [[PhotonLight]].
    */
  var chain: Int = 0

  def start(): Unit =
    anyNonSpecularBounces = false
    densityRatio = 0.0
    casterRatio = 0.0
    emitterRatio = 0.0
    chain = Manifolds.SpecularFromCamera

  /** The path has emerged from beneath a surface: no light path competes, and no walks begin. */
  def emerge(): Unit =
    anyNonSpecularBounces = true
    densityRatio = 0.0
    chain = Manifolds.NoWalks

  /** Becomes a copy. */
  def set(from: PathHistory): Unit =
    anyNonSpecularBounces = from.anyNonSpecularBounces
    densityRatio = from.densityRatio
    casterRatio = from.casterRatio
    emitterRatio = from.emitterRatio
    bsdfPdf = from.bsdfPdf
    chain = from.chain
