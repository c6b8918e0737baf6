package candela.guiding

import candela.base.loop
import candela.math.*

/** Fits lobes to the photons of a region. Mutable, one per worker.
  *
  * A photon tells where light comes from at its own place. How that changes is known in three ways:
  * the direction stays, as that of the sun; or it is that to the last point where the light was
  * scattered; or it changes as the light path did when it was started aside. Each photon takes what
  * foretells best the directions of photons near it, and its lobe is as wide as that is wrong.
  *
  * @param order of photons, region by region
  * @param to    numbers of all lobes, in this order
  */
private[guiding] final class PhotonLobes(
    photons: FieldPhotons,
    order: Array[Int],
    to: Array[Float]
):
  import FieldPhotons.{Direction, Distance, Known, Power}
  import PhotonField.{Change, End, Factor, Sharpness, Size}
  import PhotonLobes.*
  private val from = photons.data
  private val errors = new Array[Float](PhotonFieldBuilder.Most)
  private val direction = new Array[Float](3)
  private val change, best = new Array[Float](9)

  def apply(begin: Int, end: Int): Unit =
    val last = Math.min(end, begin + PhotonFieldBuilder.Most)
    var i = begin
    var total = 0.0
    while i < last do
      total += from(order(i) * FieldPhotons.Size + Power)
      i += 1
    var sum = 0.0
    i = begin
    while i < last do
      val at = order(i) * FieldPhotons.Size
      val own = i * Size
      System.arraycopy(from, at, to, own, Change)
      val width = fit(at, begin, last)
      System.arraycopy(best, 0, to, own + Change, 9)
      val sharpness = 1f / square(width)
      val weight = from(at + Power) / total
      sum += weight
      to(own + Sharpness) = sharpness
      to(own + Factor) = (weight * (1.0 + 2.0 * sharpness) / (4.0 * Math.PI)).toFloat
      to(own + End) = if i == last - 1 then 1f else sum.toFloat
      i += 1

  /** Finds the change of the photon's direction that foretells others best; returns its error. */
  private def fit(at: Int, begin: Int, end: Int): Float =
    var least = Float.PositiveInfinity
    var kind = 0
    while kind < (if from(at + Known) > 0f then 3 else 2) do
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
        foretell(at, other)
        errors(count) = sqrt(
          square(direction(0) - from(other + Direction)) +
            square(direction(1) - from(other + Direction + 1)) +
            square(direction(2) - from(other + Direction + 2))
        )
        count += 1
      i += 1
    if count == 0 then Widest
    else
      java.util.Arrays.sort(errors, 0, count)
      errors(Math.min(Neighbours, count) - 1)

  /** The photon's direction at the place of another. */
  private def foretell(at: Int, other: Int): Unit =
    val x = from(other) - from(at)
    val y = from(other + 1) - from(at + 1)
    val z = from(other + 2) - from(at + 2)
    loop(3): a =>
      direction(a) = from(at + Direction + a) +
        change(3 * a) * x + change(3 * a + 1) * y + change(3 * a + 2) * z
    val s = 1f / sqrt(square(direction(0)) + square(direction(1)) + square(direction(2)))
    loop(3)(a => direction(a) *= s)

private object PhotonLobes:
  /** Others whose directions a photon's lobe covers. */
  inline val Neighbours = 4

  /** Widths of lobes, in radians. */
  inline val Narrowest = 3e-3f
  inline val Widest = 0.5f
