package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, ShadingPoint}
import candela.math.*

/** Directions into which a light shines: all of its points alike.
  *
  * @param axis unit, in world space
  */
sealed abstract class Beam(val axis: Vec3):
  /** Scale of the emission at an angle to the axis. */
  def apply(cosine: Float): Float

  /** The same for the mean over what an unscaled light emits. */
  def mean: Float

/** A spotlight's cone: a smoothstep of the cosine between its edge and its inner cone. */
final class Cone(axis: Vec3, cosEdge: Float, cosFull: Float) extends Beam(axis):
  def apply(cosine: Float): Float =
    if cosine <= cosEdge then 0f
    else if cosine >= cosFull then 1f
    else Fade.Cubic((cosine - cosEdge) / (cosFull - cosEdge))

  def mean: Float = SpotLight.solidAngle(cosEdge, cosFull) / (4f * Pi)

/** A grid of slats before a plane light, which hide the more of it the farther it is seen from the
  * axis. The light is as much brighter, so that its power stays.
  *
  * @param angle at which nothing of the light is seen, in radians; below π/2
  */
final class Grid(axis: Vec3, angle: Double) extends Beam(axis):
  private val edge = Math.tan(angle)

  /** Keeps the power: ∫ (tan angle − tan a) cos a over the hemisphere is π (tan angle − angle),
    * which is a difference of near-equal numbers for a small angle.
    */
  private val scale =
    (if angle < Grid.Small then 3 / (angle * angle * angle) else 1 / (edge - angle))
      .toFloat

  def apply(cosine: Float): Float =
    if cosine <= 0f then 0f
    else
      val tangent = sqrt(Math.max(0f, 1f - cosine * cosine)) / cosine
      Math.max(0f, (edge.toFloat - tangent) * scale)

  def mean: Float = 1f

object Grid:
  /** Below, `tan x − x` is x³/3 within 0.2 %. */
  private val Small = 0.05

/** An area light whose emission is a beam.
  *
  * @param even uniform light on the same surface
  */
final class BeamLight(even: AreaLight, beam: Beam) extends ModulatedLight(even):
  protected def strength: Float = beam.mean

  def radiance(at: ShadingPoint, w: Vec3): Rgb = even.radiance(at, w) * beam(w dot beam.axis)

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    even.sample(from, u1, u2, out)
    if out.pdf > 0f then out.radiance.scale(beam(-(out.wi dot beam.axis)))

  override def emit(
      scene: Ball,
      u1: Float,
      u2: Float,
      v1: Float,
      v2: Float,
      out: EmittedRay
  ): Unit =
    even.emit(scene, u1, u2, v1, v2, out)
    out.radiance = out.radiance * beam(out.direction dot beam.axis)
