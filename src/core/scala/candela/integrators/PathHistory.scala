package candela.integrators

/** What [[PathTechniques]] remember of a path beside its state: how it has scattered, the densities
  * with which light paths would have made it, and whether photons replace what it meets. Mutable;
  * each branch that waits has a copy.
  */
private[candela] final class PathHistory(path: PathState):
  export path.{carried, depth, isAlone, lastN, lastP}

  /** Has the path been scattered other than by specular surfaces? */
  var anyNonSpecularBounces: Boolean = false

  /** As long as a light path may have made the path: the density with which it would have come to
    * the vertex by the path's own; else 0. See [[CausticWeights]].
    */
  var densityRatio: Double = 0.0

  /** Likewise at an emitter that the ray may meet, as far as it is known before, if the last vertex
    * is a caster, where light paths begin; else 0.
    */
  var casterRatio: Double = 0.0

  /** The solid-angle density of the current direction, without guiding, where the last is above 0;
    * 0: it is specular.
    */
  var bsdfPdf: Float = 0f

  /** What the path has met since it gathered photons: a state of [[PhotonLight]], which decides
    * what is left to them.
    */
  var gatherState: Int = PhotonLight.NoGatherYet

  def start(): Unit =
    anyNonSpecularBounces = false
    densityRatio = 0.0
    casterRatio = 0.0
    gatherState = PhotonLight.NoGatherYet

  /** The path has emerged from beneath a surface: no light path competes, and no photon begins. */
  def emerge(): Unit =
    anyNonSpecularBounces = true
    densityRatio = 0.0
    gatherState = PhotonLight.NoGatherYet

  /** Becomes a copy. */
  def set(from: PathHistory): Unit =
    anyNonSpecularBounces = from.anyNonSpecularBounces
    densityRatio = from.densityRatio
    casterRatio = from.casterRatio
    bsdfPdf = from.bsdfPdf
    gatherState = from.gatherState
