package candela.shapes

import candela.math.*

/** What spheres share that differ in their place alone: a million particles take eighty bytes each.
  *
  * @param map transform of one of them; the others differ in its translation
  */
private[candela] final class SphereForm(
    val map: Transform,
    val radius: Float,
    val zMin: Float,
    val zMax: Float,
    val phiMax: Float,
    val reversed: Boolean
):
  val full: Boolean = zMin <= -radius && zMax >= radius && phiMax >= TwoPi
  val thetaMin: Double = Math.acos(clamp(zMin / radius, -1f, 1f).toDouble)
  val thetaMax: Double = Math.acos(clamp(zMax / radius, -1f, 1f).toDouble)
  val uniformScale: Option[Float] = map.uniformScale.map(_.toFloat)
  val worldRadius: Float = radius * uniformScale.getOrElse(1f)

  /** Can the cone of directions to it be sampled? */
  val conical: Boolean = full && uniformScale.isDefined

  /** Is the transform `map` with another translation? */
  def fits(t: Transform): Boolean =
    var i = 0
    while i < 16 && (i == 3 || i == 7 || i == 11 || isSame(t, i)) do i += 1
    i == 16

  private def isSame(t: Transform, i: Int): Boolean =
    isIdentical(t.m(i), map.m(i)) && isIdentical(t.inverseM(i), map.inverseM(i))

  /** To the bit, so that no result depends on what a sphere shares. */
  private def isIdentical(a: Double, b: Double): Boolean =
    java.lang.Double.doubleToRawLongBits(a) == java.lang.Double.doubleToRawLongBits(b)

/** Spheres of the same numbers, each with a transform of its own. Parameters as of [[Sphere]]. */
final class Spheres(radius: Float, zMin: Float, zMax: Float, phiMax: Float):
  private var last: SphereForm | Null = null

  /** The sphere with this transform; it shares what it can with the one before. */
  def apply(objectToWorld: Transform, reversed: Boolean): Sphere =
    val cached = last
    val form =
      if cached != null && cached.reversed == reversed && cached.fits(objectToWorld) then cached
      else SphereForm(objectToWorld, radius, zMin, zMax, phiMax, reversed)
    last = form
    new Sphere(form, objectToWorld)
