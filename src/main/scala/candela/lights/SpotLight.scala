package candela.lights

import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*

/** How a spotlight fades between its bright cone and its edge. */
enum Fade:
  /** The fourth power of the way from the edge, in cosines: pbrt-v2 and v3. */
  case Quartic

  /** 3t² − 2t³ of it: pbrt-v4. */
  case Cubic

  /** For `t` from 0 at the edge to 1. */
  def apply(t: Float): Float = this match
    case Quartic => square(square(t))
    case Cubic => t * t * (3f - 2f * t)

/** A cone of light from a point along `axis` (unit, in light space).
  *
  * @param all     intensity within the bright cone, in W·sr⁻¹
  * @param cosEdge of the angle between axis and edge, where the light ends
  * @param cosFull of the angle where it begins to fade
  */
final class SpotLight(
    frame: LightFrame,
    axis: Vec3,
    all: Rgb,
    cosEdge: Float,
    cosFull: Float,
    fade: Fade
) extends ConeLight(frame, axis, 1f - cosEdge):

  def intensity(w: Vec3): Rgb =
    val cosine = frame.toLight(w) dot axis
    if cosine < cosEdge then Rgb.Black
    else if cosine >= cosFull then all
    else all * fade((cosine - cosEdge) / (cosFull - cosEdge))

  def bounds: Option[LightBounds] =
    val power = 4f * Pi * all.max
    val fading = Math.acos(clamp(cosEdge, -1f, 1f)) - Math.acos(clamp(cosFull, -1f, 1f))
    if !frame.keepsAngles || fading >= Math.PI / 2 then
      Some(LightBounds.everywhere(frame.position, power))
    else
      Some(
        LightBounds(
          Bounds3(frame.position, frame.position),
          frame.toWorld(axis),
          cosFull,
          Math.cos(Math.max(0.0, fading)).toFloat - PositionedLight.Slack,
          power,
          twoSided = false
        )
      )

object SpotLight:
  /** ∫ of the intensity over all directions, where it is 1 within the bright cone, for
    * [[Fade.Cubic]]: the fading part counts half.
    */
  def solidAngle(cosEdge: Float, cosFull: Float): Float =
    TwoPi * ((1f - cosFull) + (cosFull - cosEdge) * 0.5f)
