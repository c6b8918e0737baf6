package candela.lights

import candela.concurrency.Parallel
import candela.geometry.{Ball, Bounds3}
import candela.math.*
import candela.sampling.Discrete

/** Light sampling distribution over the lights of a scene. Immutable.
  *
  * Normals are those of the side on which light is received, which lights behind the surface are
  * not likely to reach; zero where light is received from all directions.
  */
abstract class LightSelection:

  /** Samples a light for the point `p` with normal `n`, and computes its probability. */
  def choose(p: Vec3, n: Vec3, u: Float, out: LightChoice): Unit

  /** Probability with which `choose` samples `light`. */
  def probability(p: Vec3, n: Vec3, light: Int): Float

  /** Does the choice depend on the random number? */
  def isRandom: Boolean = true

  def describe: String

/** A sampled light with its probability; mutable, one per worker. */
final class LightChoice:
  /** Index of the light; −1 if none can contribute. */
  var light: Int = -1
  var probability: Float = 0f

  private var numbers = new Array[Float](0)

  /** Scratch memory for so many numbers. */
  private[lights] def scratch(count: Int): Array[Float] =
    if numbers.length < count then numbers = new Array[Float](count)
    numbers

/** The only light. */
final class SingleLight extends LightSelection:
  def probability(p: Vec3, n: Vec3, light: Int): Float = 1f
  def choose(p: Vec3, n: Vec3, u: Float, out: LightChoice): Unit =
    out.light = 0
    out.probability = 1f
  override def isRandom: Boolean = false
  def describe: String = "one light"

/** Importance sampling over a light BVH of [[LightBounds]]: descends by the importance of the two
  * children; each light at infinity is as likely as the whole tree.
  *
  * Source: Conty Estevez and Kulla 2018, see [[LightBounds]].
  */
final class LightTree(lights: Array[Light], pool: Parallel = Parallel.Alone)
    extends LightSelection:
  private val infinite: Array[Int] =
    lights.indices.filter(i => lights(i).bounds.isEmpty && lights(i).isSampled).toArray

  // What is needed for building alone takes more memory than the tree
  private val (nodes, children, trail) =
    val builder = LightTreeBuilder(lights, pool)
    (LightNodes(builder.bounds, pool), builder.children, builder.trail)

  private val hasFinite = children.nonEmpty

  def describe: String = s"${lights.length} lights, sampled by importance (light BVH)"

  private val infiniteShare: Float =
    1f / Math.max(1, infinite.length + (if hasFinite then 1 else 0))

  def choose(p: Vec3, n: Vec3, u: Float, out: LightChoice): Unit =
    out.probability = infiniteShare
    val inInfinite = infinite.length * infiniteShare
    if infinite.length > 0 && (u < inInfinite || !hasFinite) then
      out.light = infinite(Math.min((u / infiniteShare).toInt, infinite.length - 1))
    else if !hasFinite then out.light = -1
    else descend(p, n, belowOne((u - inInfinite) / (1f - inInfinite)), out)

  private def descend(p: Vec3, n: Vec3, u0: Float, out: LightChoice): Unit =
    var u = u0
    var node = 0
    if children(0) < 0 && nodes.importance(0, p, n) <= 0f then out.light = -1
    else
      var probability = out.probability
      while node >= 0 && children(node) >= 0 do
        val second = children(node)
        val a = nodes.importance(node + 1, p, n)
        val b = nodes.importance(second, p, n)
        if !(a + b > 0f) then node = -1
        else
          val pa = a / (a + b)
          if u < pa then
            u = belowOne(u / pa)
            probability *= pa
            node += 1
          else
            u = belowOne((u - pa) / (1f - pa))
            probability *= b / (a + b)
            node = second
      out.light = if node < 0 then -1 else ~children(node)
      out.probability = if node < 0 then 0f else probability

  def probability(p: Vec3, n: Vec3, light: Int): Float =
    if lights(light).bounds.isEmpty then (if lights(light).isSampled then infiniteShare else 0f)
    else if trail(light) < 0 then 0f
    else if children(0) < 0 && nodes.importance(0, p, n) <= 0f then 0f
    else
      var bits = trail(light)
      var node = 0
      var probability = infiniteShare
      while children(node) >= 0 do
        val second = children(node)
        val a = nodes.importance(node + 1, p, n)
        val b = nodes.importance(second, p, n)
        if !(a + b > 0f) then return 0f
        if (bits & 1L) == 0L then
          probability *= a / (a + b)
          node += 1
        else
          probability *= b / (a + b)
          node = second
        bits >>>= 1
      probability

object LightSelection:
  /** The simplest exact specialisation for these lights.
    *
    * @param scene bounds of all surfaces
    * @param pool  builds it
    */
  def of(
      lights: Array[Light],
      strategy: LightStrategy,
      scene: Bounds3,
      pool: Parallel = Parallel.Alone
  ): LightSelection =
    strategy match
      case _ if lights.length == 1 => SingleLight()
      case LightStrategy.Importance =>
        if FewLights.suits(lights) then FewLights(lights) else LightTree(lights, pool)
      case LightStrategy.Power => FixedSelection.byPower(lights, Ball.enclosing(scene))
      case LightStrategy.Uniform => FixedSelection.uniform(lights)

/** Light sampling strategy.
  *
  * The choice affects noise only. `Importance` depends on position and normal (a light BVH),
  * `Power` on the emitted power; `Uniform` samples all lights with equal probability.
  */
enum LightStrategy:
  case Importance, Power, Uniform

/** Fixed probabilities, independent of position.
  *
  * @param weights of the lights, in any unit; 0 means never sampled
  *
  * Source: PBRT 3rd ed., §14.3.1; 4th ed., §12.6.1 and §12.6.2.
  */
final class FixedSelection(weights: Array[Float], override val describe: String)
    extends LightSelection:
  private val table: Discrete | Null = if weights.exists(_ > 0f) then Discrete(weights) else null

  def probability(p: Vec3, n: Vec3, light: Int): Float =
    val picks = table
    if picks == null then 0f else picks.probability(light)

  def choose(p: Vec3, n: Vec3, u: Float, out: LightChoice): Unit =
    val picks = table
    out.light = if picks == null then -1 else picks.sample(u)
    out.probability = if picks == null then 0f else picks.probability(out.light)

object FixedSelection:
  /** @param scene bounding sphere of all surfaces, which lights at infinity illuminate */
  def byPower(lights: Array[Light], scene: Ball): FixedSelection =
    val powers = lights.map(l => if l.isSampled then Discrete.weight(l.power(scene)) else 0f)
    val positive = powers.filter(_ > 0f)
    val mean = if positive.isEmpty then 1f else positive.sum / positive.length
    // The power that a portal admits is unknown
    val weights = lights.zip(powers).map: (light, power) =>
      if power == 0f && light.isSampled && light.bounds.isEmpty then mean else power
    FixedSelection(weights, s"${lights.length} lights, sampled by power")

  def uniform(lights: Array[Light]): FixedSelection =
    FixedSelection(
      lights.map(l => if l.isSampled then 1f else 0f),
      s"${lights.length} lights, sampled uniformly"
    )
