package candela.lights

import candela.base.loop
import candela.image.Image
import candela.math.*

/** Angles by which a light was measured, in LM-63's terms. */
enum PhotometricType:
  /** Polar angles from the nadir, −y, in half-planes around +y, of which the first contains +x and
    * that of 90° +z.
    */
  case C

  /** Elevations above the horizon, and azimuths around +y; the beam, of angles 0 and 0, is +z. */
  case A

  /** Angles from the vertical plane of the beam, in half-planes that turn around +x, up from +z. */
  case B

/** Luminous intensity of a light over directions, interpolated between measured ones: zero beyond
  * the measured polar angles, and mirrored where half or a quarter of the planes was measured.
  *
  * @param vertical, horizontal ascending angles, in degrees
  * @param candelas of all vertical angles in the first plane, then in the next
  */
final class Photometry(
    kind: PhotometricType,
    vertical: Array[Float],
    horizontal: Array[Float],
    candelas: Array[Float]
):
  private val rows = vertical.length
  private val first = horizontal.head
  private val last = horizontal.last

  /** Candelas in the unit direction `d`, in the space of a [[GoniometricLight]]. */
  def apply(d: Vec3): Float = kind match
    case PhotometricType.C =>
      val azimuth = Math.toDegrees(Math.atan2(d.z.toDouble, d.x.toDouble))
      intensity(Photometry.arc(-d.y), folded(if azimuth < 0 then azimuth + 360 else azimuth))
    case PhotometricType.A =>
      beside(90 - Photometry.arc(d.y), Math.toDegrees(Math.atan2(d.x.toDouble, d.z.toDouble)))
    case PhotometricType.B =>
      beside(Math.toDegrees(Math.atan2(d.y.toDouble, d.z.toDouble)), 90 - Photometry.arc(d.x))

  /** Types A and B, mirrored where they start with 0. */
  private def beside(v: Double, h: Double): Float =
    def mirrored(angle: Double, angles: Array[Float]) =
      if angles.head >= 0f then Math.abs(angle) else angle
    val across = mirrored(h, horizontal)
    if horizontal.length > 1 && (across < first - Slack || across > last + Slack) then 0f
    else intensity(mirrored(v, vertical), across)

  /** The angle among the measured planes that has the same intensities. */
  private def folded(h: Double): Double =
    if horizontal.length == 1 then first
    else if first == 0f && last == 90f then
      val halfTurn = h % 180
      if halfTurn > 90 then 180 - halfTurn else halfTurn
    else if first == 0f && last == 180f then if h > 180 then 360 - h else h
    else if first == 180f && last == 360f then if h < 180 then 360 - h else h
    else if first == 90f && last == 270f then
      if h < 90 then 180 - h else if h > 270 then 540 - h else h
    else if h < first then h + 360
    else h

  private def intensity(v: Double, h: Double): Float =
    if v < vertical.head - Slack || v > vertical.last + Slack then 0f
    else
      val below = Photometry.below(vertical, v)
      val t = Photometry.fraction(v, vertical(below), vertical(Math.min(below + 1, rows - 1)))
      val plane = Photometry.below(horizontal, h)
      val isLast = plane == horizontal.length - 1
      val next = if isLast then 0 else plane + 1
      val end = if isLast then first + 360f else horizontal(next)
      val s = if horizontal.length == 1 then 0f else Photometry.fraction(h, horizontal(plane), end)
      lerp(s, along(plane, below, t), along(next, below, t))

  private def along(plane: Int, below: Int, t: Float): Float =
    lerp(t, candelas(plane * rows + below), candelas(plane * rows + Math.min(below + 1, rows - 1)))

  private def lerp(t: Float, a: Float, b: Float): Float = a + t * (b - a)

  private def Slack = 1e-3

  /** The light as the equirectangular image of a [[GoniometricLight]], to be interpolated: four
    * pixels between measured angles.
    */
  def image: Image =
    val isRound = kind == PhotometricType.C && horizontal.length == 1
    val height = Photometry.pixels(vertical, 180, 180, 720)
    val width = if isRound then 1 else Photometry.pixels(horizontal, 360, 180, 1440)
    val result = Image.rgb(width, height)
    loop(height): y =>
      loop(width): x =>
        val d = LatLongMap.toDirection((x + 0.5f) / width, (y + 0.5f) / height)
        val value = apply(Vec3(d.x, d.z, d.y))
        loop(3)(c => result.data((y * width + x) * 3 + c) = value)
    result

object Photometry:
  private def arc(x: Float): Double = Math.toDegrees(Math.acos(clamp(x, -1f, 1f).toDouble))

  /** Index of the last angle that is not above `x`, or 0. */
  private def below(angles: Array[Float], x: Double): Int =
    var i = angles.length - 1
    while i > 0 && angles(i) > x do i -= 1
    i

  private def fraction(x: Double, from: Float, to: Float): Float =
    if to > from then clamp(((x - from) / (to - from)).toFloat, 0f, 1f) else 0f

  private def pixels(angles: Array[Float], range: Int, fewest: Int, most: Int): Int =
    val steps = (1 until angles.length).map(i => angles(i) - angles(i - 1))
    val needed = if steps.isEmpty then 0f else 4 * range / steps.min
    Math.max(fewest, Math.min(Math.ceil(needed.toDouble).toInt, most))
