package candela.geometry

import candela.math.*

/** A right-handed orthonormal basis; `toLocal` gives coordinates in which `n` is +z. Immutable, as
  * its vectors are.
  */
final class Frame(val s: Vec3, val t: Vec3, val n: Vec3):
  def toLocal(v: Vec3): Vec3 = Vec3(v dot s, v dot t, v dot n)
  def toWorld(v: Vec3): Vec3 = Vec3(
    s.x * v.x + t.x * v.y + n.x * v.z,
    s.y * v.x + t.y * v.y + n.y * v.z,
    s.z * v.x + t.z * v.y + n.z * v.z
  )

object Frame:
  /** Some basis around the unit vector `n`, continuous except at n.z = 0. It keeps `n` itself, for
    * immediate use: of one that is mutable, keep the basis around its `toVec3`.
    *
    * Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    */
  def fromZ(n: Vec3): Frame =
    val (s, t) = (MutableVec3(), MutableVec3())
    basis(n, s, t)
    Frame(s.toVec3, t.toVec3, n)

  /** Sets `s` and `t` to those of the basis around `n`. */
  def basis(n: Vec3, s: MutableVec3, t: MutableVec3): Unit =
    val sign = Math.copySign(1f, n.z)
    val a = -1f / (sign + n.z)
    val b = n.x * n.y * a
    s.set(1f + sign * n.x * n.x * a, sign * b, -sign * n.x)
    t.set(b, sign + n.y * n.y * a, -n.y)

  /** Basis around the unit vector `n` whose `s` follows `along`, orthogonalised to `n`. */
  def along(n: Vec3, along: Vec3): Frame =
    val s = along - n * (along dot n)
    val length2 = s.lengthSquared
    if length2 > 1e-12f * along.lengthSquared && length2 > 0f then
      // Orthogonalised twice: if the vector is almost parallel to n, the first difference is mostly
      // rounding (Parlett, "The Symmetric Eigenvalue Problem", §6.9: twice is enough)
      val approximate = s.normalized
      val unit = (approximate - n * (approximate dot n)).normalized
      Frame(unit, n cross unit, n)
    else fromZ(n)

/** Storage for a [[Frame]] in a record that a worker reuses; initially the axes. */
final class MutableFrame:
  private val ownS = MutableVec3(1f, 0f, 0f)
  private val ownT = MutableVec3(0f, 1f, 0f)
  private val ownN = MutableVec3(0f, 0f, 1f)

  def s: MutableVec3 = ownS
  def t: MutableVec3 = ownT
  def n: MutableVec3 = ownN

  /** A copy of the current value. */
  def toFrame: Frame = Frame(ownS.toVec3, ownT.toVec3, ownN.toVec3)

  def set(f: Frame): Unit =
    ownS.set(f.s)
    ownT.set(f.t)
    ownN.set(f.n)

  /** Sets the basis to [[Frame.fromZ]] its current normal. */
  def alignToNormal(): Unit =
    Frame.basis(ownN, ownS, ownT)

  def toLocal(v: Vec3): Vec3 = Vec3(v dot ownS, v dot ownT, v dot ownN)
  def toWorld(v: Vec3): Vec3 =
    val world = MutableVec3()
    toWorld(v, world)
    world.toVec3

  /** As above, written to `out`: a vector returned by a method that the JIT does not inline is
    * allocated.
    */
  def toLocal(v: Vec3, out: MutableVec3): Unit = out.set(v dot ownS, v dot ownT, v dot ownN)
  def toWorld(v: Vec3, out: MutableVec3): Unit = out.set(
    ownS.x * v.x + ownT.x * v.y + ownN.x * v.z,
    ownS.y * v.x + ownT.y * v.y + ownN.y * v.z,
    ownS.z * v.x + ownT.z * v.y + ownN.z * v.z
  )
