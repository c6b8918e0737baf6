package candela.lights

import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*

/** Falloff of a spotlight between its inner cone and its edge. */
enum Fade:
  /** Fourth power of the distance from the edge, in cosines: pbrt-v2 and v3. */
  case Quartic

  /** Smoothstep, 3t² − 2t³: pbrt-v4. */
  case Cubic

  /** Linear in the angle: Mitsuba. */
  case Linear

  /** Square of the distance from the edge, in cosines: glTF. */
  case Square

  /** Evaluates the falloff for `t` from 0 (edge) to 1, in the unit of the falloff. */
  def apply(t: Float): Float = this match
    case Quartic => square(square(t))
    case Cubic => t * t * (3f - 2f * t)
    case Linear => t
    case Square => square(t)

/** Spotlight along `axis` (unit, in light space).
  *
  * @param all     intensity within the inner cone, in W·sr⁻¹
  * @param cosEdge cosine of the angle between axis and edge, where the light ends
  * @param cosFull cosine of the angle at which the falloff begins
  * @param slide   scales the light, as in Mitsuba: its width and height span the cone, x to the
  *   right in light space
  */
final class SpotLight(
    frame: LightFrame,
    axis: Vec3,
    all: Rgb,
    cosEdge: Float,
    cosFull: Float,
    fade: Fade,
    slide: Option[Picture] = None
) extends ConeLight(frame, axis, 1f - cosEdge):
  private val picture = slide.orNull
  private val tanEdge = sqrt(Math.max(0f, 1f - cosEdge * cosEdge)) / cosEdge
  private val edge = Math.acos(cosEdge)
  private val full = Math.acos(cosFull)

  def intensity(w: Vec3): Rgb =
    val d = frame.toLight(w)
    val cosine = d dot axis
    if cosine < cosEdge then Rgb.Black
    else
      val lit = if cosine >= cosFull then all else all * fade(inward(cosine))
      if picture == null then lit
      else
        val across = 0.5f / (d.z * tanEdge)
        lit * picture(0.5f + d.x * across, 0.5f + d.y * across)

  /** Position between edge (0) and inner cone (1). */
  private def inward(cosine: Float): Float =
    if fade == Fade.Linear then ((edge - Math.acos(cosine)) / (edge - full)).toFloat
    else (cosine - cosEdge) / (cosFull - cosEdge)

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
  /** ∫ of the intensity over all directions for unit intensity within the inner cone and
    * [[Fade.Cubic]]: the falloff region has weight 1/2.
    */
  def solidAngle(cosEdge: Float, cosFull: Float): Float =
    TwoPi * ((1f - cosFull) + (cosFull - cosEdge) * 0.5f)

/** Goniometric light: a point light with measured intensity, stored as an image over all
  * directions.
  *
  * The image's pole (+z of its map) is the light's +y, as in all pbrt versions.
  */
final class GoniometricLight(frame: LightFrame, image: SphereImage)
    extends RoundLight(frame.position):

  def intensity(w: Vec3): Rgb =
    val d = frame.toLight(w)
    image(Vec3(d.x, d.z, d.y))

  def bounds: Option[LightBounds] =
    Some(LightBounds.everywhere(frame.position, 4f * Pi * image.meanOfMax))

/** Projection light at a point, looking along its +z.
  *
  * @param tanHalf tangent of half the field of view of the image's shorter side
  * @param slide   image to project; if empty, a white square
  * @param upright whether the top of the image is at the light's +y, as in pbrt-v4; at −y in v2 and
  *   v3
  * @param onPlane whether a plane across the axis shows the image as it is, as in Mitsuba; pbrt's
  *   images are intensities, and get darker to the sides
  */
final class ProjectionLight(
    frame: LightFrame,
    all: Rgb,
    tanHalf: Float,
    slide: Option[Picture],
    upright: Boolean,
    onPlane: Boolean = false
) extends ConeLight(frame, Vec3.Z, ProjectionLight.spread(slide, tanHalf)):
  private val picture = slide.orNull
  private val screen = ProjectionLight.Screen(slide.fold(1f)(_.aspect), tanHalf)

  def intensity(w: Vec3): Rgb =
    val d = frame.toLight(w)
    if d.z < ProjectionLight.MinCosine then Rgb.Black
    else
      val x = (d.x / (d.z * screen.halfWidth) + 1f) * 0.5f
      val vertical = d.y / (d.z * screen.halfHeight)
      val y = ((if upright then -vertical else vertical) + 1f) * 0.5f
      if x < 0f || x > 1f || y < 0f || y > 1f then Rgb.Black
      else
        val light = if picture == null then all else all * picture(x, y)
        if onPlane then light * (1f / (d.z * d.z * d.z)) else light

  def bounds: Option[LightBounds] =
    val mean = slide.fold(1f)(_.meanOfMax)
    val maxFactor = if onPlane then 1f / (screen.cosCorner * square(screen.cosCorner)) else 1f
    val power = 4f * Pi * all.max * mean * maxFactor
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
  /** Nothing is projected at smaller cosines with the axis, as in all pbrt versions. */
  private inline val MinCosine = 1e-3f

  /** 1 − cos of a cone that contains the image. */
  private def spread(slide: Option[Picture], tanHalf: Float): Float =
    1f - Screen(slide.fold(1f)(_.aspect), tanHalf).cosCorner + PositionedLight.Slack

  /** The image plane at distance 1 from the projector. */
  final class Screen(aspect: Float, tanHalf: Float):
    val halfWidth: Float = tanHalf * Math.max(1f, aspect)
    val halfHeight: Float = tanHalf * Math.max(1f, 1f / aspect)
    def area: Float = 4f * halfWidth * halfHeight
    def cosCorner: Float = 1f / sqrt(1f + square(halfWidth) + square(halfHeight))

    /** Steradians per image area at (x, y): the cube of the cosine. */
    def stretch(x: Float, y: Float): Float =
      val length2 = 1f + square((2f * x - 1f) * halfWidth) + square((2f * y - 1f) * halfHeight)
      1f / (length2 * sqrt(length2))

  /** Total power that `slide` transmits, in lumens.
    *
    * @param luminance luminance of a colour
    */
  def power(slide: Picture, tanHalf: Float, luminance: Rgb => Float): Float =
    val screen = Screen(slide.aspect, tanHalf)
    screen.area * slide.mean((c, x, y) => luminance(c) * screen.stretch(x, y))

/** Position and orientation of a light: maps between light and world directions. Directions are
  * returned with unit length, whatever the transform scales.
  */
final class LightFrame(lightToWorld: Transform):
  private val toWorldRows = lightToWorld.m.map(_.toFloat)
  private val toLightRows = lightToWorld.inverseM.map(_.toFloat)

  /** Position in world space. */
  val position: Vec3 = lightToWorld.point(Vec3.Zero)

  /** Whether the transform preserves angles; false for anisotropic scaling. */
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
