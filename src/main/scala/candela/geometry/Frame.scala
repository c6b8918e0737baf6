package candela.geometry

import candela.math.*

/** A right-handed orthonormal basis; `toLocal` gives coordinates in which `n` is +z. Like [[Vec3]]
  * a value, but for those that a record owns.
  */
final class Frame(val s: Vec3, val t: Vec3, val n: Vec3):
  def copy: Frame = Frame(s.copy, t.copy, n.copy)

  /** Takes the values of `f`; for the owner alone, who owns its vectors, too. */
  private[candela] def become(f: Frame): Unit =
    s.become(f.s)
    t.become(f.t)
    n.become(f.n)

  /** Becomes a basis around the unit vector `axis`, as [[Frame.around]] makes it; for the owner. */
  private[candela] def becomeAround(axis: Vec3): Unit =
    val around = Frame.around(axis)
    s.become(around.s)
    t.become(around.t)
    n.become(axis)

  def toLocal(v: Vec3): Vec3 = Vec3(v dot s, v dot t, v dot n)
  def toWorld(v: Vec3): Vec3 = Vec3(
    s.x * v.x + t.x * v.y + n.x * v.z,
    s.y * v.x + t.y * v.y + n.y * v.z,
    s.z * v.x + t.z * v.y + n.z * v.z
  )

object Frame:
  /** Any basis around the unit vector `n`, continuous but for n.z = 0.
    *
    * Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    */
  def around(n: Vec3): Frame =
    val sign = Math.copySign(1f, n.z)
    val a = -1f / (sign + n.z)
    val b = n.x * n.y * a
    Frame(
      Vec3(1f + sign * n.x * n.x * a, sign * b, -sign * n.x),
      Vec3(b, sign + n.y * n.y * a, -n.y),
      n
    )

  /** The basis around the unit vector `n` whose `s` follows `along` (made perpendicular to `n`). */
  def along(n: Vec3, along: Vec3): Frame =
    val s = along - n * (along dot n)
    val length2 = s.lengthSquared
    if length2 > 1e-12f * along.lengthSquared && length2 > 0f then
      // Once more: of a vector nearly along n, the difference above is mostly rounding (Parlett,
      // "The Symmetric Eigenvalue Problem", §6.9: twice is enough)
      val once = s.normalized
      val unit = (once - n * (once dot n)).normalized
      Frame(unit, n cross unit, n)
    else around(n)
