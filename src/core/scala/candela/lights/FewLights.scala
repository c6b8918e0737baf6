package candela.lights

import candela.math.*

/** Importance sampling over few lights: each in proportion to an estimate of what it contributes;
  * each light at infinity is as likely as all others together. A loop without branches, which takes
  * less time than a descent of [[LightTree]] and knows each light better than the tree's nodes do.
  *
  * The estimate for a flat light of power Φ and bounding sphere of radius r at distance d is
  * Φ·√(h(h + 2r))·(s + r) / (d² + r²)², where h and s are the distances of the light's plane and
  * of the surface's from the other's centre: for r ≪ d the product of both cosines over d².
  */
final class FewLights(lights: Array[Light]) extends LightSelection:
  import FewLights.*

  private val infinite: Array[Int] =
    lights.indices.filter(i => lights(i).bounds.isEmpty && lights(i).isSampled).toArray

  // In the order of their kinds
  private val finite: Array[(Int, LightBounds)] =
    val indexed =
      for i <- lights.indices.toArray; b <- lights(i).bounds if b.power > 0f yield (i, b)
    indexed.sortBy((_, b) => kind(b))
  private val index = finite.map(_._1)
  private val count = finite.length
  private val round = finite.count((_, b) => kind(b) == Flat)
  private val bounded = count - finite.count((_, b) => kind(b) == Bounded)

  /** Position in `finite` by light, or −1. */
  private val slots = lights.indices.map(index.indexOf(_)).toArray

  private val data = finite.flatMap((_, b) => row(b))

  /** For those that need more than a radius and a side. */
  private val nodes = LightNodes(finite.map(_._2))

  private val infiniteShare: Float =
    1f / Math.max(1, infinite.length + (if count == 0 then 0 else 1))

  def describe: String = s"${lights.length} lights, sampled by importance (few: no light BVH)"

  def choose(p: Vec3, n: Vec3, u: Float, out: LightChoice): Unit =
    val inInfinite = infinite.length * infiniteShare
    out.probability = infiniteShare
    if infinite.length > 0 && (u < inInfinite || count == 0) then
      out.light = infinite(Math.min((u / infiniteShare).toInt, infinite.length - 1))
    else
      val weights = out.scratch(2 * count)
      val total = weigh(p, n, weights)
      if !(total > 0f) then
        out.light = -1
        out.probability = 0f
      else
        val k = select((u - inInfinite) / (1f - inInfinite) * total, weights)
        out.light = index(k)
        out.probability = infiniteShare * (weights(k) / total)

  /** The light in whose part of the sums the goal is. */
  private def select(goal: Float, weights: Array[Float]): Int =
    // Counts without a branch: none could be predicted
    var selected = 0
    var k = count
    while k < 2 * count do
      selected += (if weights(k) <= goal then 1 else 0)
      k += 1
    // Rounding may leave the goal beyond the sum
    if selected == count then selected -= 1
    while selected > 0 && !(weights(selected) > 0f) do selected -= 1
    selected

  def probability(p: Vec3, n: Vec3, light: Int): Float =
    if lights(light).bounds.isEmpty then (if lights(light).isSampled then infiniteShare else 0f)
    else if slots(light) < 0 then 0f
    else
      var lightWeight = 0f
      val slot = slots(light)
      val total = sum(p, n)((k, w, _) => if k == slot then lightWeight = w)
      if lightWeight > 0f then infiniteShare * (lightWeight / total) else 0f

  /** Sets the importance of each light, and behind these their sums up to each; returns the sum of
    * all.
    */
  private def weigh(p: Vec3, n: Vec3, weights: Array[Float]): Float =
    sum(p, n): (k, w, before) =>
      weights(k) = w
      weights(count + k) = before

  /** Sum of the importances.
    *
    * @param each receives light, importance, and the sum up to it
    */
  private inline def sum(p: Vec3, n: Vec3)(inline each: (Int, Float, Float) => Unit): Float =
    val x = p.x
    val y = p.y
    val z = p.z
    val nx = n.x
    val ny = n.y
    val nz = n.z
    val isOpen = n.isZero
    var total = 0f
    var k = 0
    while k < round do
      val w = importance(k, x, y, z, nx, ny, nz, isOpen): (along, _, at) =>
        // 2h on the sides to which the light emits, else 0
        val height = along * data(at + 8) + Math.abs(along) * data(at + 9)
        sqrt(height * (height + 4 * data(at + 6)))
      total += w
      each(k, w, total)
      k += 1
    while k < bounded do
      val w = importance(k, x, y, z, nx, ny, nz, isOpen)((_, d2, _) => sqrt(d2))
      total += w
      each(k, w, total)
      k += 1
    while k < count do
      val w = nodes.importance(k, p, n)
      total += w
      each(k, w, total)
      k += 1
    total

  /** @param emitted cosine at the light times distance, from the distance to its plane and the
    *                square of that to its centre
    */
  private inline def importance(
      k: Int,
      px: Float,
      py: Float,
      pz: Float,
      nx: Float,
      ny: Float,
      nz: Float,
      isOpen: Boolean
  )(inline emitted: (Float, Float, Int) => Float): Float =
    val offset = Stride * k
    val x = data(offset) - px
    val y = data(offset + 1) - py
    val z = data(offset + 2) - pz
    val d2 = x * x + y * y + z * z
    val along = -(x * data(offset + 3) + y * data(offset + 4) + z * data(offset + 5))
    val received =
      if isOpen then sqrt(d2)
      else LightNodes.inFront(x * nx + y * ny + z * nz + data(offset + 6))
    val inverse = 1f / (d2 + data(offset + 10))
    data(offset + 7) * (emitted(along, d2, offset) * inverse) * (received * inverse)

object FewLights:
  private inline val Stride = 11

  // Kinds of lights
  private inline val Flat = 0
  private inline val Omnidirectional = 1
  private inline val Bounded = 2

  /** Prevents an overflow next to a point light. */
  private inline val MinSquaredDistance = 1e-30f

  /** Time of the general estimate, in units of that of a flat light. */
  private inline val BoundedCost = 6

  /** Time of a descent of a [[LightTree]], in the same unit. */
  private inline val MaxCost = 40

  /** Are these so few that a loop over all is faster than a tree? */
  private[lights] def suits(lights: Array[Light]): Boolean =
    var cost = 0
    var i = 0
    while i < lights.length && cost <= MaxCost do
      for b <- lights(i).bounds do cost += (if kind(b) == Bounded then BoundedCost else 1)
      i += 1
    cost <= MaxCost

  private def kind(b: LightBounds): Int =
    if b.cosNormals == -1f then Omnidirectional
    else if b.cosNormals == 1f && b.cosEmission == 0f then Flat
    else Bounded

  private def row(b: LightBounds): Array[Float] =
    val center = b.box.center
    Array(
      center.x,
      center.y,
      center.z,
      b.axis.x,
      b.axis.y,
      b.axis.z,
      b.box.radius,
      if b.twoSided then 0.5f * b.power else b.power,
      if b.twoSided then 0f else 1f,
      if b.twoSided then 2f else 1f,
      Math.max(square(b.box.radius), MinSquaredDistance)
    )
