package candela.bsdf.subsurface

import candela.bsdf.{Bsdf, Bssrdf, DiffuseTransmission, Fresnel}
import candela.color.Rgb
import candela.math.*

/** The light of a point source beneath a surface and of its mirror image above, in one channel: the
  * classical dipole.
  *
  * Source: Jensen, Marschner, Levoy, Hanrahan, "A Practical Model for Subsurface Light Transport",
  * SIGGRAPH 2001, §2.1.
  *
  * @param absorption coefficient
  * @param scattering coefficient, reduced
  * @param eta        index of refraction of the medium over that outside
  */
final class DipoleProfile(absorption: Float, scattering: Float, eta: Float):
  private val extinction = absorption + scattering
  private val albedo = if extinction > 0f then scattering / extinction else 0f
  private val effective = sqrt(3f * absorption * extinction)

  /** Depth of the source, and height of its image. */
  private val (real, image) =
    val depth = 1f / extinction
    (depth, depth * (1f + DipoleProfile.imageShift(eta)))

  private val ofReal = 0.5f * albedo * exp(-effective * real)
  private val ofImage = 0.5f * albedo * exp(-effective * image)

  /** The part of light that comes out again, with an infinite plane. */
  val reflectance: Float =
    if extinction > 0f && extinction < Float.PositiveInfinity then ofReal + ofImage else 0f

  /** Exitance at the distance `d`. */
  def apply(d: Float): Float =
    if reflectance > 0f then albedo * InvPi * 0.25f * (term(real, d) + term(image, d)) else 0f

  private def term(z: Float, r: Float): Float =
    val way = sqrt(r * r + z * z)
    z * (1f + effective * way) * exp(-effective * way) / (way * way * way)

  /** A radius that a part `u` of the light doesn't reach: of one of the two sources, each of which
    * can be integrated. Only where `reflectance` > 0.
    */
  def sample(u: Float): Float =
    val part = ofReal / reflectance
    if u < part then radius(real, u / part) else radius(image, (u - part) / (1f - part))

  /** Beyond the way d to it, a source at `z` sends z/d·e^(−σ(d−z)) of its light. */
  private def radius(z: Float, u: Float): Float =
    val target = -Math.log1p(-Math.min(u, OneMinusEpsilon).toDouble)
    val steepness = effective.toDouble * z
    // x = log(d/z); Newton's method for a convex function, begun beyond its zero
    var x = if steepness > 0 then Math.min(target, Math.log1p(target / steepness)) else target
    var step = 1.0
    while step > 1e-7 do
      val growth = Math.exp(x)
      step = (x + steepness * (growth - 1) - target) / (1 + steepness * growth)
      x -= step
    (z * Math.sqrt(Math.max(0.0, Math.exp(2 * x) - 1))).toFloat

object DipoleProfile:
  /** How much farther than the source the image is from the surface, in depths of the source. */
  private def imageShift(eta: Float): Float =
    val inner = FresnelMoments.diffuse(eta)
    4f / 3f * (1f + inner) / (1f - inner)

  /** The reduced albedo of the medium of which an infinite plane reflects this part of light. */
  def albedoOf(reflectance: Float, eta: Float): Float =
    val shift = imageShift(eta)
    var low = 0f
    var high = 1f
    while high - low > 1e-5f do
      val middle = 0.5f * (low + high)
      val root = sqrt(3f * (1f - middle))
      val reflected = 0.5f * middle * (1f + exp(-shift * root)) * exp(-root)
      if reflected < reflectance then low = middle else high = middle
    0.5f * (low + high)

/** The dipole in three channels, with diffuse light at both ends.
  *
  * @param counted the part of the surface that counts
  */
final class DipoleBssrdf(
    r: DipoleProfile,
    g: DipoleProfile,
    b: DipoleProfile,
    eta: Float,
    counted: Float
) extends Bssrdf:
  private val profiles = Array(r, g, b)
  private val farthest =
    profiles.filter(_.reflectance > 0f).map(_.sample(DipoleBssrdf.Reached)).maxOption.getOrElse(-1f)
  private val scale = (1f - FresnelMoments.diffuse(eta)) * counted

  def apply(distance: Float): Rgb =
    Rgb(r(distance), g(distance), b(distance)) * scale

  def density(radius: Float): Float =
    (density(r, radius) + density(g, radius) + density(b, radius)) * (1f / 3f)

  private def density(p: DipoleProfile, radius: Float): Float =
    if p.reflectance > 0f then p(radius) / p.reflectance else 0f

  def sample(channel: Int, u: Float): Float =
    if profiles(channel).reflectance > 0f then profiles(channel).sample(u) else -1f

  /** The same for all: what one channel lights from afar is near the axis for others, too. */
  def reach(channel: Int): Float = farthest

  /** What gets out through the surface at this angle. */
  def leaving(cosine: Float): Float = 1f - Fresnel.dielectric(Math.abs(cosine), eta)

  /** From either side: of a closed body, no light reaches the inner one. PBRT 2 puts a point on
    * the one or the other side by chance.
    */
  val entry: Bsdf = DiffuseTransmission(Rgb.White, Rgb.White)

object DipoleBssrdf:
  /** The dipole falls off slowly where little is absorbed. */
  private inline val Reached = 0.9999f
