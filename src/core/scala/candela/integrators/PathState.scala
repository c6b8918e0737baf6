package candela.integrators

import candela.color.{MutableRgb, Rgb}
import candela.math.*
import candela.media.PathWeights

/** What a path from the camera carries from vertex to vertex: all that its next steps depend on,
  * but its ray. Mutable. A path tracer has one, and each branch that waits has a copy.
  *
  * The estimate of a path is the sum of β · w · L over all light that it meets or samples: light of
  * radiance L that its ray meets, or that is sampled at one of its vertices. It is unbiased: its
  * mean is the radiance that arrives at the camera after at most `maxDepth` scattering events.
  *
  *   - β, the [[throughput]], is the product of f·|cos|/p over the vertices so far, where p is the
  *     density with which the direction was sampled. The mean of β · L over all directions is
  *     therefore the integral of f·|cos|·L, whatever the density, if it is above 0 where the
  *     integrand is. The same holds for everything else that is decided at random: the factor is
  *     divided by the probability. Russian roulette goes on with β/q in q of all cases, and
  *     otherwise with 0.
  *   - Light that two techniques sample, because the path may go there by itself, counts with the
  *     weights w of multiple importance sampling. Those of both add up to 1. Each needs both
  *     densities, but a ray that meets an emitter has left the vertex where the emitter could have
  *     been sampled. So the path remembers the density of its direction, and the position and
  *     normal of that vertex.
  *   - A light that isn't sampled, as a uniform sky may be, is chosen with probability 0: the path
  *     that meets it has the weight 1.
  *   - In a homogeneous medium, β also has T·σs/p of a sampled distance, where T is the
  *     transmittance, or T/P of passing it with the probability P. In a varying one T is not known:
  *     [[candela.media.VaryingMedium]] samples collisions with a majorant m, and β has σs/m over
  *     the probability of scattering, or (m − σt)/m over that of going on. Phase functions are
  *     sampled exactly: their f/p is 1.
  *   - A guided direction has the mixture's density for p. Splitting into n expected branches
  *     divides β by n ([[Guidance]]). Light paths take 1 − w of what both find
  *     ([[CausticWeights]]). Photon maps ([[PhotonLight]]) are biased.
  *
  * Between surfaces one density is enough ([[SurfacePath]]). In media each colour has its own
  * ([[VolumePath]]).
  *
  * Sources: Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach 1997, §9.2 and §10; PBRT 4th
  * ed., §13.2 and §14.2, which calls them β, r_u and r_l.
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

  /** Where the current direction was sampled, and the normal with which light sampling chose a
    * light there; zero where light may come from all sides.
    */
  final val lastP, lastN: MutableVec3 = MutableVec3()

  /** β. */
  def throughput: Rgb

  /** Multiplies the throughput by f·|cos|/p, or by what stands for it. */
  def scale(factor: Rgb): Unit
  def scale(factor: MutableRgb): Unit
  def scale(factor: Float): Unit

  /** Ends the path: its throughput becomes 0. */
  def absorb(): Unit

  /** Is the throughput 0? */
  def isBlack: Boolean

  /** β · w · L. */
  def carried(radiance: Rgb, weight: Float = 1f): Rgb

  /** Does light sampling miss what the current direction meets? So it does if the direction is
    * specular, or the camera's, or if lights aren't sampled.
    */
  def lightSamplingMisses: Boolean

  /** Weight of light that the path meets, if light sampling may sample it, too: the path's own
    * density against that of light sampling. Power heuristic.
    *
    * @param choice probability with which light sampling would have chosen the light
    * @param pdf    solid-angle density with which it would have sampled the point
    */
  def emissionWeight(choice: Float, pdf: Float): Float

  /** Leaves `p` in a sampled direction.
    *
    * @param n   normal for the choice of lights there
    * @param pdf solid-angle density of the direction; 0 if light sampling misses what it meets
    */
  final def startSegment(p: Vec3, n: Vec3, pdf: Float): Unit =
    lastP.set(p)
    lastN.set(n)
    startSegment(pdf)

  protected def startSegment(pdf: Float): Unit

  /** Does the path carry its hero wavelength only? */
  def isAlone: Boolean

  /** Goes on with the hero wavelength in place of all three: dispersion has parted them. */
  def terminateSecondary(): Unit

  /** Starts a path at the camera. */
  def start(): Unit =
    depth = 0
    passed = 0
    etaScale = 1f

  /** A new one of the same kind. */
  def another(): PathState

  /** Becomes a copy of another of the same kind. */
  def set(from: PathState): Unit =
    depth = from.depth
    passed = from.passed
    etaScale = from.etaScale
    lastP.set(from.lastP)
    lastN.set(from.lastN)

/** What a path between surfaces carries: one density for all colours. Mutable. */
final class SurfacePath extends PathState:
  val beta: MutableRgb = MutableRgb()
  private var alone = false

  /** Solid-angle density of the current direction (`p_b`); 0 if light sampling misses what it
    * meets; [[SurfacePath.DensityOfLoss]] if what it meets counts nothing.
    */
  private var bsdfPdf = 0f

  def throughput: Rgb = beta.toRgb
  def scale(factor: Rgb): Unit = beta.scale(factor)
  def scale(factor: MutableRgb): Unit = beta.scale(factor)
  def scale(factor: Float): Unit = beta.scale(factor)
  def absorb(): Unit = beta.set(Rgb.Black)
  def isBlack: Boolean = beta.isBlack
  def carried(radiance: Rgb, weight: Float): Rgb = beta.toRgb * radiance * weight
  def lightSamplingMisses: Boolean = bsdfPdf == 0f

  def emissionWeight(choice: Float, pdf: Float): Float =
    if bsdfPdf > 0f then LightTransport.powerHeuristic(bsdfPdf, choice * pdf) else 0f

  protected def startSegment(pdf: Float): Unit = bsdfPdf = pdf

  /** Passes an interface. If light samples end there, either the path alone finds what is behind
    * it, or nothing does.
    */
  def pass(interfaces: Interfaces): Unit =
    if bsdfPdf > 0f then
      interfaces match
        case Interfaces.Closed => bsdfPdf = 0f
        case Interfaces.Lossy => bsdfPdf = SurfacePath.DensityOfLoss
        case Interfaces.Open | Interfaces.Weighed => ()

  def isAlone: Boolean = alone

  def terminateSecondary(): Unit =
    alone = true
    beta.scale(LightTransport.Hero)

  override def start(): Unit =
    super.start()
    beta.set(Rgb.White)
    alone = false
    bsdfPdf = 0f

  def another(): SurfacePath = SurfacePath()

  override def set(from: PathState): Unit =
    super.set(from)
    val source = from.asInstanceOf[SurfacePath]
    beta.set(source.beta)
    alone = source.alone
    bsdfPdf = source.bsdfPdf

private object SurfacePath:
  inline val DensityOfLoss = -1f

/** What a path through media carries: throughput, and two kinds of densities, for each colour.
  * Media scatter colours at different distances, so a path that one colour has sampled is weighted
  * against those of the others ([[candela.media.PathWeights]]). Mutable.
  *
  * @param weights which media change on the way, and [[candela.media.MediumWork]] starts
  */
final class VolumePath(val weights: PathWeights = PathWeights()) extends PathState:

  /** Index of the medium around the path, −1: none. */
  var medium: Int = -1

  def throughput: Rgb = weights.throughput
  def scale(factor: Rgb): Unit = weights.scale(factor)
  def scale(factor: MutableRgb): Unit = weights.scale(factor)
  def scale(factor: Float): Unit = weights.scale(factor)
  def absorb(): Unit = weights.scale(0f)
  def isBlack: Boolean = weights.isDead
  def carried(radiance: Rgb, weight: Float): Rgb = weights.throughput * (radiance * weight)
  def lightSamplingMisses: Boolean = !(weights.lightRatio > 0f)

  /** Densities are in units of the path's own. */
  def emissionWeight(choice: Float, pdf: Float): Float =
    LightTransport.powerHeuristic(1f, weights.lightRatio * choice * pdf)

  protected def startSegment(pdf: Float): Unit = weights.startSegment(pdf)

  def isAlone: Boolean = weights.isAlone
  def terminateSecondary(): Unit = weights.keepHero()

  def another(): VolumePath = VolumePath()

  override def set(from: PathState): Unit =
    super.set(from)
    val source = from.asInstanceOf[VolumePath]
    weights.set(source.weights)
    medium = source.medium
