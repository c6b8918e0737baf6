package candela.geometry

import candela.math.*

/** All points within `radius` of a point: what light from infinitely far away is aimed at. */
final case class Ball(center: Vec3, radius: Float):
  /** Of the disc that it is seen as from any direction. */
  val area: Float = Pi * radius * radius

object Ball:
  def around(box: Bounds3): Ball = Ball(if box.isEmpty then Vec3.Zero else box.center, box.radius)
