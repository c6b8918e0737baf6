package candela.lights

import candela.math.*
import candela.sampling.Warp

/** Mapping between an image and the sphere of directions; (x, y) in [0, 1], y down from the top.
  */
abstract class SphereMap:

  /** Image position of the unit direction `d`, as (x, y, 0). */
  def toImage(d: Vec3): Vec3

  /** Unit direction of an image position. */
  def toDirection(x: Float, y: Float): Vec3

  /** Steradians per unit of image area; 0 where the mapping degenerates. */
  def stretch(y: Float): Float

  /** Weight of row `y` of `height` when pixels are chosen. */
  def share(y: Int, height: Int): Float = stretch((y + 0.5f) / height)

  /** Maps pixels outside a `width` × `height` image back into it. */
  def wrapX(x: Int, y: Int, width: Int, height: Int): Int
  def wrapY(x: Int, y: Int, width: Int, height: Int): Int

/** Equirectangular mapping: longitude along x, colatitude from +z down y; the layout of pbrt-v2's
  * and v3's `mapname`.
  */
object LatLongMap extends SphereMap:
  def toImage(d: Vec3): Vec3 =
    val phi = Math.atan2(d.y.toDouble, d.x.toDouble).toFloat
    val theta = Math.acos(clamp(d.z, -1f, 1f).toDouble).toFloat
    Vec3(clamp((if phi < 0f then phi + TwoPi else phi) * InvTwoPi, 0f, 1f), theta * InvPi, 0f)

  def toDirection(x: Float, y: Float): Vec3 =
    sinCos(y * Math.PI)((sine, cosine) => Warp.spherical(cosine.toFloat, sine.toFloat, x))

  def stretch(y: Float): Float = 2f * Pi * Pi * sin(y * Pi)

  def wrapX(x: Int, y: Int, width: Int, height: Int): Int = Math.floorMod(x, width)

  // Beyond a pole pbrt reads the opposite row, as for a repeating texture
  def wrapY(x: Int, y: Int, width: Int, height: Int): Int = Math.floorMod(y, height)

/** As [[LatLongMap]], but the centres of the first and last rows are the poles, as in Mitsuba.
  *
  * @param rows of the image
  */
final class PolarLatLongMap(rows: Int) extends SphereMap:
  private val steps = Math.max(rows - 1, 1).toFloat

  def toImage(d: Vec3): Vec3 =
    val uv = LatLongMap.toImage(d)
    Vec3(uv.x, (uv.y * steps + 0.5f) / rows, 0f)

  def toDirection(x: Float, y: Float): Vec3 = LatLongMap.toDirection(x, colatitude(y))

  /** From 0 to 1, constant in the outer halves of the first and last rows. */
  private def colatitude(y: Float): Float = clamp((y * rows - 0.5f) / steps, 0f, 1f)

  def stretch(y: Float): Float =
    val v = (y * rows - 0.5f) / steps
    if v > 0f && v < 1f then LatLongMap.stretch(v) * rows / steps else 0f

  /** The inner half of the rows at the poles. */
  override def share(y: Int, height: Int): Float =
    0.5f * (stretch((y + 0.25f) / height) + stretch((y + 0.75f) / height))

  def wrapX(x: Int, y: Int, width: Int, height: Int): Int = Math.floorMod(x, width)
  def wrapY(x: Int, y: Int, width: Int, height: Int): Int = Math.max(0, Math.min(y, height - 1))

/** The equal-area octahedral mapping of pbrt-v4's environment maps.
  *
  * Source: Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", JGT 13(3), 2008.
  */
object EqualAreaMap extends SphereMap:
  def toImage(d: Vec3): Vec3 =
    val ax = Math.abs(d.x)
    val ay = Math.abs(d.y)
    val az = Math.abs(d.z)
    val r = safeSqrt(1f - az)
    // Position in the first octant, in [0, 1]
    val longer = if ax >= ay then ax else ay
    val shorter = if ax >= ay then ay else ax
    val angle = if longer == 0f then 0f else arcTangent(shorter / longer) * (2f * InvPi)
    val phi = if ax >= ay then angle else 1f - angle
    val v0 = phi * r
    val u0 = r - v0
    val u = if d.z < 0f then 1f - v0 else u0
    val v = if d.z < 0f then 1f - u0 else v0
    Vec3((Math.copySign(u, d.x) + 1f) * 0.5f, (Math.copySign(v, d.y) + 1f) * 0.5f, 0f)

  /** Arctangent for `x` in [0, 1], with an error of at most 2e-8 plus rounding; `Math.atan2` took 6
    * % of a render with an environment map. Source: Abramowitz and Stegun, "Handbook of
    * Mathematical Functions", 1964, 4.4.49.
    */
  private def arcTangent(x: Float): Float =
    val z = x * x
    val high = (((0.0028662257f * z - 0.0161657367f) * z + 0.0429096138f) * z - 0.0752896400f) * z
    x * (((((high + 0.1065626393f) * z - 0.1420889944f) * z + 0.1999355085f) * z -
      0.3333314528f) * z + 1f)

  def toDirection(x: Float, y: Float): Vec3 =
    val u = 2f * x - 1f
    val v = 2f * y - 1f
    val au = Math.abs(u)
    val av = Math.abs(v)
    val signed = 1f - (au + av)
    val r = 1f - Math.abs(signed)
    // From the middle of the octant
    val phi = if r == 0f then 0.0 else 0.25 * Math.PI * ((av - au) / r)
    val horizontal = r * safeSqrt(1f - 0.5f * (r * r))
    val along = cosOfEighth(phi).toFloat
    val across = sinOfEighth(phi).toFloat
    Vec3(
      Math.copySign((along - across) * horizontal, u),
      Math.copySign((along + across) * horizontal, v),
      Math.copySign(1f - r * r, signed)
    )

  def stretch(y: Float): Float = 4f * Pi

  // Outside a border the octahedron continues at the same border, reflected about its midpoint
  def wrapX(x: Int, y: Int, width: Int, height: Int): Int =
    val inside = if x < 0 then -1 - x else if x >= width then 2 * width - 1 - x else x
    if y < 0 || y >= height then width - 1 - inside else inside
  def wrapY(x: Int, y: Int, width: Int, height: Int): Int =
    val inside = if y < 0 then -1 - y else if y >= height then 2 * height - 1 - y else y
    if x < 0 || x >= width then height - 1 - inside else inside
