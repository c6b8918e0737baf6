package candela.lights

import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*

/** A slide projector at a point, looking along its +z.
  *
  * @param tanHalf of half the angle of the image's shorter side
  * @param slide   None: all of the (square) image is white
  * @param upright is the image's top on the light's +y? So in pbrt-v4; in v2 and v3 on −y
  */
final class ProjectionLight(
    frame: LightFrame,
    all: Rgb,
    tanHalf: Float,
    slide: Option[Picture],
    upright: Boolean
) extends ConeLight(frame, Vec3.Z, ProjectionLight.spread(slide, tanHalf)):
  private val picture = slide.orNull
  private val screen = ProjectionLight.Screen(slide.fold(1f)(_.aspect), tanHalf)

  def intensity(w: Vec3): Rgb =
    val d = frame.toLight(w)
    if d.z < ProjectionLight.Near then Rgb.Black
    else
      val x = (d.x / (d.z * screen.halfWidth) + 1f) * 0.5f
      val up = d.y / (d.z * screen.halfHeight)
      val y = ((if upright then -up else up) + 1f) * 0.5f
      if x < 0f || x > 1f || y < 0f || y > 1f then Rgb.Black
      else if picture == null then all
      else all * picture(x, y)

  def bounds: Option[LightBounds] =
    val mean = slide.fold(1f)(_.mean((c, _, _) => c.max))
    val power = 4f * Pi * all.max * mean
    if !frame.keepsAngles then Some(LightBounds.everywhere(frame.position, power))
    else
      Some(
        LightBounds(
          Bounds3(frame.position, frame.position),
          frame.toWorld(Vec3.Z),
          1f,
          screen.cosCorner - PositionedLight.Slack,
          power,
          twoSided = false
        )
      )

object ProjectionLight:
  /** Cosine between axis and direction below which nothing is projected, as in all of pbrt. */
  private inline val Near = 1e-3f

  /** 1 − cos of a cone that holds the image. */
  private def spread(slide: Option[Picture], tanHalf: Float): Float =
    1f - Screen(slide.fold(1f)(_.aspect), tanHalf).cosCorner + PositionedLight.Slack

  /** The image at distance 1 from the projector. */
  final class Screen(aspect: Float, tanHalf: Float):
    val halfWidth: Float = tanHalf * Math.max(1f, aspect)
    val halfHeight: Float = tanHalf * Math.max(1f, 1f / aspect)
    def area: Float = 4f * halfWidth * halfHeight
    def cosCorner: Float = 1f / sqrt(1f + square(halfWidth) + square(halfHeight))

    /** Steradians per area at the place (x, y) of the image: the cube of the cosine. */
    def stretch(x: Float, y: Float): Float =
      val length2 = 1f + square((2f * x - 1f) * halfWidth) + square((2f * y - 1f) * halfHeight)
      1f / (length2 * sqrt(length2))

  /** Total power that `slide` lets through, in lumens.
    *
    * @param luminance of its colours
    */
  def power(slide: Picture, tanHalf: Float, luminance: Rgb => Float): Float =
    val screen = Screen(slide.aspect, tanHalf)
    screen.area * slide.mean((c, x, y) => luminance(c) * screen.stretch(x, y))
