package candela.guiding

import candela.geometry.Frame
import candela.math.*

/** Lobes around directions, as seen from one point, which are located there and sampled by their
  * weights. Mutable, one per worker.
  *
  * @param most lobes
  */
private[guiding] abstract class LobeMixture(most: Int):
  protected final val xs, ys, zs, factors, ends = new Array[Float](most)
  protected final var count = 0
  private val place = new Array[Float](3)

  /** The coordinates of a point. */
  protected final def placeOf(p: Vec3): Array[Float] =
    place(0) = p.x
    place(1) = p.y
    place(2) = p.z
    place

  /** Sets the axis of a lobe to this direction, of any length. */
  protected final def turn(k: Int, x: Float, y: Float, z: Float): Unit =
    val s = 1f / Math.max(sqrt(x * x + y * y + z * z), 1e-12f)
    xs(k) = x * s
    ys(k) = y * s
    zs(k) = z * s

  /** The lobe that `u` chooses. Each is a strip of the square, so that evenly spread points give
    * evenly spread directions.
    */
  protected final def chosen(u: Float): Int =
    var k = 0
    while k < count - 1 && u >= ends(k) do k += 1
    k

  /** Where `u` lies in the strip of the lobe, from 0 to 1. */
  protected final def within(u: Float, k: Int): Float =
    val begin = if k == 0 then 0f else ends(k - 1)
    Math.max(0f, Math.min((u - begin) / (ends(k) - begin), 1f))

  protected final def frame(k: Int): Frame = Frame.around(Vec3(xs(k), ys(k), zs(k)))
