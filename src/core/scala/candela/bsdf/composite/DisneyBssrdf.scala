package candela.bsdf.composite

import candela.bsdf.{Bsdf, Bssrdf}
import candela.bsdf.subsurface.{Interior, NormalizedFresnel}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.Textured

/** Disney's BSSRDF: a profile fitted to Monte Carlo references, two exponentials that integrate to
  * the colour.
  *
  * Source: Burley, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering",
  * SIGGRAPH 2015 course, eq. 5; Christensen and Burley, "Approximate Reflectance Profiles for
  * Efficient Subsurface Scattering", Pixar Technical Memo 15-04, 2015, for the sampling. The
  * surface terms at entry and exit are those of [[TabulatedBssrdf]], as in PBRT 3.
  *
  * @param color    albedo of the profile
  * @param distance shape parameter d, in scene units; a channel with 0 is black
  * @param eta      index of refraction inside over that outside
  */
final class DisneyBssrdf(color: Rgb, distance: Rgb, val eta: Float) extends Bssrdf:
  import DisneyBssrdf.*
  private val lengths = Array(distance.r, distance.g, distance.b)
  private val colors = Array(color.r, color.g, color.b)

  val entry: Bsdf = NormalizedFresnel(eta)

  def apply(distance: Float): Rgb =
    val r = Math.max(distance, Nearest)
    Rgb(factor(0, r), factor(1, r), factor(2, r)) * (eta * eta)

  private def factor(channel: Int, r: Float): Float = colors(channel) * profile(lengths(channel), r)

  def density(radius: Float): Float =
    val r = Math.max(radius, Nearest)
    (profile(lengths(0), r) + profile(lengths(1), r) + profile(lengths(2), r)) * (1f / 3f)

  def sample(channel: Int, u: Float): Float = DisneyBssrdf.radius(lengths(channel), u)

  def reach(channel: Int): Float = DisneyBssrdf.radius(lengths(channel), Reached)

private object DisneyBssrdf:
  /** Lower clamp of the radius: the profile grows like 1/r. */
  private inline val Nearest = 1e-6f

  /** As in [[TabulatedBssrdf]]. Truncates more than a thousandth of the slower exponential. */
  private inline val Reached = 0.999f

  /** The normalised profile, per unit area. */
  private def profile(d: Float, r: Float): Float =
    if d > 0f then (exp(-r / d) + exp(-r / (3f * d))) / (8f * Pi * d * r) else 0f

  /** Samples the radius. The steeper exponential holds a quarter of the energy. */
  private def radius(d: Float, u: Float): Float =
    if !(d > 0f) then -1f
    else if u < 0.25f then -d * log1m(4f * u)
    else -3f * d * log1m((u - 0.25f) * (1f / 0.75f))

  /** log(1 − x), for x clamped below 1. */
  private def log1m(x: Float): Float =
    Math.log1p(-Math.min(x, OneMinusEpsilon).toDouble).toFloat

/** The interior of [[DisneyMaterial]]. */
final class DisneyInterior(p: DisneyParameters) extends Interior, Textured(p):
  def bssrdf(at: ShadingPoint): Bssrdf | Null =
    val distance = p.distance(at)
    val share = (1f - p.metallic(at)) * (1f - p.transmission(at))
    if distance.isBlack || !(share > 0f) then null
    else
      val color = p.color.positive(at) * share
      DisneyBssrdf(color, distance * DisneyInterior.Shape, p.eta(at))

private object DisneyInterior:
  /** Shape parameter d for a mean free path of 1, as in PBRT 3. */
  private inline val Shape = 0.2f
