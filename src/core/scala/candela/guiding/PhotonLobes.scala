package candela.guiding

import candela.base.loop
import candela.math.*

/** Fits lobes to the photons of a region. Mutable, one per worker.
  *
  * A photon tells where light comes from at its own place. How that changes is known in three ways:
  * the direction stays, as that of the sun; or it is that to the last point where the light was
  * scattered; or it changes as the light path did when it was started aside. Each photon takes what
  * foretells best the directions of photons near it, and its lobe is as wide as that is wrong.
  * Photons that a lobe foretells add to its weight.
  *
  * @param order of photons, region by region
  * @param to    numbers of all lobes, in this order
  */
private[guiding] final class PhotonLobes(
    photons: FieldPhotons,
    order: Array[Int],
    to: Array[Float]
):
  import FieldPhotons.{Direction, Distance, HasChange, Power}
  import PhotonField.{Change, End, Factor, Sharpness, Size}
  import PhotonLobes.*
  private val from = photons.data
  private val errors = new Array[Float](PhotonFieldBuilder.MaxPhotons)
  private val direction = new Array[Float](3)
  private val weights = new Array[Float](PhotonMixture.MaxLobes)
  private val change, best = new Array[Float](9)

  /** Fits lobes to the photons of a region, which are written where its first would be.
    *
    * @return their number
    */
  def apply(begin: Int, end: Int): Int =
    val last = Math.min(end, begin + PhotonFieldBuilder.MaxPhotons)
    var count = 0
    var i = begin
    while i < last do
      val at = order(i) * FieldPhotons.Size
      val known = foreteller(at, begin * Size, count)
      if known >= 0 then weights(known) += from(at + Power)
      else if count < PhotonMixture.MaxLobes then
        val own = begin * Size + count * Size
        System.arraycopy(from, at, to, own, Change)
        to(own + Sharpness) = 1f / square(fit(at, begin, last))
        System.arraycopy(best, 0, to, own + Change, 9)
        weights(count) = from(at + Power)
        count += 1
      i += 1
    weigh(begin * Size, count)
    count

  /** The lobe that foretells the photon's direction best, if any does; else −1. */
  private def foreteller(at: Int, lobes: Int, count: Int): Int =
    var found = -1
    var least = square(MaxWidths)
    var k = 0
    while k < count do
      val own = lobes + k * Size
      val distance = square(error(to, own, to, own + Change, at)) * to(own + Sharpness)
      if distance < least then
        least = distance
        found = k
      k += 1
    found

  private def weigh(lobes: Int, count: Int): Unit =
    var total, sum = 0.0
    loop(count)(k => total += weights(k))
    loop(count): k =>
      val own = lobes + k * Size
      val weight = weights(k) / total
      sum += weight
      to(own + Factor) =
        (weight * (1.0 + 2.0 * to(own + Sharpness)) / (4.0 * Math.PI)).toFloat
      to(own + End) = if k == count - 1 then 1f else sum.toFloat

  /** Finds the change of the photon's direction that foretells others best; returns its error. */
  private def fit(at: Int, begin: Int, end: Int): Float =
    var least = Float.PositiveInfinity
    var kind = 0
    while kind < (if from(at + HasChange) > 0f then 3 else 2) do
      take(kind, at)
      val error = wrong(at, begin, end)
      if error < least then
        least = error
        System.arraycopy(change, 0, best, 0, 9)
      kind += 1
    Math.max(Narrowest, Math.min(least, Widest))

  private def take(kind: Int, at: Int): Unit =
    kind match
      case 0 => java.util.Arrays.fill(change, 0f)
      case 1 =>
        val near = -1f / from(at + Distance)
        loop(9): k =>
          val across = from(at + Direction + k / 3) * from(at + Direction + k % 3)
          change(k) = near * ((if k % 4 == 0 then 1f else 0f) - across)
      case _ => System.arraycopy(from, at + FieldPhotons.Change, change, 0, 9)

  /** How wrong the photon is about the directions of others: those that it foretells best. */
  private def wrong(at: Int, begin: Int, end: Int): Float =
    var count = 0
    var i = begin
    while i < end do
      val other = order(i) * FieldPhotons.Size
      if other != at then
        errors(count) = error(from, at, change, 0, other)
        count += 1
      i += 1
    if count == 0 then Widest
    else
      java.util.Arrays.sort(errors, 0, count)
      errors(Math.min(Neighbours, count) - 1)

  /** How far the direction at the place of `other` is from that which is foretold.
    *
    * @param by,byAt       where position and direction are of what foretells
    * @param turns,turnsAt how its direction changes
    */
  private def error(
      by: Array[Float],
      byAt: Int,
      turns: Array[Float],
      turnsAt: Int,
      other: Int
  ): Float =
    val x = from(other) - by(byAt)
    val y = from(other + 1) - by(byAt + 1)
    val z = from(other + 2) - by(byAt + 2)
    loop(3): a =>
      val t = turnsAt + 3 * a
      direction(a) = by(byAt + Direction + a) + turns(t) * x + turns(t + 1) * y + turns(t + 2) * z
    val s = 1f / sqrt(square(direction(0)) + square(direction(1)) + square(direction(2)))
    sqrt(
      square(direction(0) * s - from(other + Direction)) +
        square(direction(1) * s - from(other + Direction + 1)) +
        square(direction(2) * s - from(other + Direction + 2))
    )

private object PhotonLobes:
  /** Others whose directions a photon's lobe covers. */
  inline val Neighbours = 4

  /** A lobe also represents photons within this many of its widths. */
  inline val MaxWidths = 1.5f

  /** Widths of lobes, in radians. */
  inline val Narrowest = 3e-3f
  inline val Widest = 0.5f
