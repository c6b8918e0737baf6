package candela.lights

import candela.math.*

/** Where a light is and how it is turned: between its own directions and the world's. Directions
  * come back with unit length, whatever the transform scales.
  */
final class LightFrame(lightToWorld: Transform):
  private val toWorldRows = lightToWorld.m.map(_.toFloat)
  private val toLightRows = lightToWorld.inverseM.map(_.toFloat)

  /** In world space. */
  val position: Vec3 = lightToWorld.point(Vec3.Zero)

  /** Are angles in the light's space those of the world? Not if the transform stretches. */
  val keepsAngles: Boolean =
    val columns = Seq(Vec3.X, Vec3.Y, Vec3.Z).map(lightToWorld.vector)
    val length2 = columns.map(_.lengthSquared).max
    val isStretched = columns.exists(c => Math.abs(c.lengthSquared - length2) > 1e-4f * length2)
    val isSheared = Seq((0, 1), (0, 2), (1, 2)).exists: (i, j) =>
      Math.abs(columns(i) dot columns(j)) > 1e-4f * length2
    !isStretched && !isSheared

  def toWorld(v: Vec3): Vec3 = times(toWorldRows, v)
  def toLight(v: Vec3): Vec3 = times(toLightRows, v)

  private def times(m: IArray[Float], v: Vec3): Vec3 =
    Vec3(
      m(0) * v.x + m(1) * v.y + m(2) * v.z,
      m(4) * v.x + m(5) * v.y + m(6) * v.z,
      m(8) * v.x + m(9) * v.y + m(10) * v.z
    ).normalized
