package candela.guiding

import candela.math.*

/** Photons of which a field is made, in order of their arrival. Mutable. */
final class FieldPhotons:
  import FieldPhotons.*
  private[guiding] var data: Array[Float] = new Array[Float](64 * Size)
  private var used = 0

  def count: Int = used

  /** @param from where it was scattered last
    * @param n    normal of the side that it has arrived at; in a medium of none
    */
  def add(p: Vec3, from: Vec3, side: Int, power: Float): Unit =
    val at = used * Size
    if at == data.length then data = java.util.Arrays.copyOf(data, 2 * data.length)
    val way = from - p
    val distance = way.length
    set(at, p)
    set(at + Direction, way * (1f / distance))
    data(at + Distance) = distance
    data(at + Power) = power
    data(at + Side) = side.toFloat
    data(at + HasChange) = 0f
    used += 1

  /** The last photon's path, started a little aside in two ways, arrives at `p1` and `p2`, where it
    * comes from these directions.
    */
  def bend(p1: Vec3, w1: Vec3, p2: Vec3, w2: Vec3): Unit =
    val at = (used - 1) * Size
    val p = get(at)
    val w = get(at + Direction)
    val (e1, e2) = (p1 - p, p2 - p)
    val n = e1 cross e2
    val area2 = n.lengthSquared
    // The dual vectors of e1 and e2 in their plane
    val (d1, d2) = ((e2 cross n) * (1f / area2), (n cross e1) * (1f / area2))
    if area2 > Flattest * e1.lengthSquared * e2.lengthSquared then
      val (f1, f2) = (w1 - w, w2 - w)
      set(at + Change, d1 * f1.x + d2 * f2.x)
      set(at + Change + 3, d1 * f1.y + d2 * f2.y)
      set(at + Change + 6, d1 * f1.z + d2 * f2.z)
      data(at + HasChange) = 1f

  /** Appends others. */
  def append(others: FieldPhotons): Unit =
    val size = (used + others.used) * Size
    if size > data.length then
      data = java.util.Arrays.copyOf(data, Math.max(size, 2 * data.length))
    System.arraycopy(others.data, 0, data, used * Size, others.used * Size)
    used += others.used

  private[guiding] def side(i: Int): Int = data(i * Size + Side).toInt

  private def get(at: Int) = Vec3(data(at), data(at + 1), data(at + 2))

  private def set(at: Int, v: Vec3): Unit =
    data(at) = v.x
    data(at + 1) = v.y
    data(at + 2) = v.z

object FieldPhotons:
  /** Numbers of a photon, and the places of some: position, direction, derivative of the direction
    * by position, row by row, and the rest.
    */
  private[guiding] inline val Size = 19
  private[guiding] inline val Direction = 3
  private[guiding] inline val Change = 6
  private[guiding] inline val Distance = 15
  private[guiding] inline val Power = 16
  private[guiding] inline val Side = 17
  private[guiding] inline val HasChange = 18

  /** Squared sine of the angle between two ways aside that tell of a plane. */
  private[guiding] inline val Flattest = 1e-4f
