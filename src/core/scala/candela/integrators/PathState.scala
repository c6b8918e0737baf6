package candela.integrators

import candela.color.{MutableRgb, Rgb}
import candela.math.*

/** What a path from the camera carries from vertex to vertex: all that its next steps depend on,
  * but its ray. Mutable. A walk has one, and each branch that waits has a copy.
  *
  * The estimate of a path is the sum of β · w · L over all light that it finds: light of radiance L
  * that its ray meets, or that is sampled at one of its vertices. It is unbiased, its mean is the
  * radiance that arrives at the camera:
  *
  *   - β, the [[throughput]], is the product of f·|cos|/p over the vertices so far, where p is the
  *     density with which the direction was sampled. The mean of β · L over all directions is
  *     therefore the integral of f·|cos|·L, whatever the density, if it is above 0 where the
  *     integrand is. The same holds for everything else that is decided at random: the factor is
  *     divided by the probability. Russian roulette goes on with β/q in q of all cases, and
  *     otherwise with 0.
  *   - Light that is found in two ways, because the path may go there by itself, counts with the
  *     weights w of multiple importance sampling. Those of both ways add up to 1. Each needs both
  *     densities, but a ray that meets an emitter has left the vertex where the emitter could have
  *     been sampled. So the path remembers the density of its direction, and the place of that
  *     vertex.
  *
  * Between surfaces one density is enough ([[SurfacePath]]). In media each colour has its own
  * ([[VolumePath]]).
  *
  * Sources: Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach 1997, §9.2 and §10; PBRT 4th
  * ed., §13.2 and §14.2, where β is `beta`.
  */
abstract class PathState:
  /** Scattering events so far. */
  final var depth: Int = 0

  /** Interfaces passed so far, if they count as events. */
  final var passed: Int = 0

  /** Product of the squared relative indices of refraction: throughput · etaScale is free of
    * radiance scaling, so Russian roulette sees the energy.
    */
  final var etaScale: Float = 1f

  /** Has the path been scattered other than by specular surfaces? Followed only if paths are
    * regularized: from there on BSDFs are roughened.
    */
  final var isSpread: Boolean = false

  /** As long as a light path may have made the path: the ratio of the density with which it would
    * have come to the vertex to the path's own, and what is known of it for an emitter that its ray
    * meets; else 0. Light paths of the first kind begin at the last vertex, a caster, those of the
    * second at the emitter. See [[CausticWeights]].
    */
  final var rival, rivalAtLight, rivalOfEmitter: Double = 0.0

  /** The solid-angle density of the current direction, without guiding, where one of the last two
    * is above 0; 0: it is specular.
    */
  final var ownPdf: Float = 0f

  /** What manifold walks may look for from here, or what is left to photons: a number of
    * [[Manifolds]] or of [[PhotonLight]].
    */
  final var chain: Int = 0

  /** Where the current direction was sampled, and the normal with which light sampling chose a
    * light there; zero where light may come from all sides.
    */
  final val lastP, lastN: MutableVec3 = MutableVec3()

  /** β. */
  def throughput: Rgb

  /** Multiplies the throughput by f·|cos|/p, or by what stands for it. */
  def scale(factor: Rgb): Unit
  def scale(factor: Float): Unit

  /** Ends the path: its throughput becomes 0. */
  def absorb(): Unit

  /** Is the throughput 0? */
  def isDead: Boolean

  /** Largest of β's colours. */
  def largest: Float

  /** β · w · L. */
  def carried(radiance: Rgb, weight: Float): Rgb

  /** Adds it to `sum`, where it need not be an object. */
  def addTo(sum: MutableRgb, radiance: Rgb, weight: Float): Unit

  /** Does light sampling at the last vertex find what the current direction meets? It doesn't if
    * the direction is the camera's, or specular.
    */
  def competes: Boolean

  /** Weight of light that the path meets, if light sampling competes: the path's own density
    * against that of light sampling. Power heuristic.
    *
    * @param choice probability with which light sampling would have chosen the light
    * @param pdf    solid-angle density with which it would have sampled the point
    */
  def emissionWeight(choice: Float, pdf: Float): Float

  /** Leaves `p` in a sampled direction.
    *
    * @param n   normal for the choice of lights there
    * @param pdf solid-angle density of the direction; 0 if light sampling does not compete with it
    */
  final def turn(p: Vec3, n: Vec3, pdf: Float): Unit =
    lastP.set(p)
    lastN.set(n)
    turn(pdf)

  protected def turn(pdf: Float): Unit

  /** Does the path carry its hero wavelength only? */
  def isAlone: Boolean

  /** Goes on with the hero wavelength in place of all three: dispersion has parted them. */
  def keepHero(): Unit

  /** Starts a path at the camera. */
  def start(): Unit =
    depth = 0
    passed = 0
    etaScale = 1f
    isSpread = false
    rival = 0.0
    rivalAtLight = 0.0
    rivalOfEmitter = 0.0
    chain = Manifolds.SpecularFromCamera

  /** A new one of the same kind. */
  def another(): PathState

  /** Becomes a copy of another of the same kind. */
  def set(from: PathState): Unit =
    depth = from.depth
    passed = from.passed
    etaScale = from.etaScale
    isSpread = from.isSpread
    rival = from.rival
    rivalAtLight = from.rivalAtLight
    rivalOfEmitter = from.rivalOfEmitter
    ownPdf = from.ownPdf
    chain = from.chain
    lastP.set(from.lastP)
    lastN.set(from.lastN)
