package candela.bsdf.subsurface

import candela.bsdf.{Bsdf, Bssrdf, DiffuseTransmission}
import candela.color.Rgb
import candela.math.*

/** The classical dipole in one channel: a point source beneath the surface and its image above.
  *
  * Source: Jensen, Marschner, Levoy, Hanrahan, "A Practical Model for Subsurface Light Transport",
  * SIGGRAPH 2001, §2.1.
  *
  * @param absorption absorption coefficient
  * @param scattering reduced scattering coefficient
  * @param eta        index of refraction of the medium over that outside
  */
final class DipoleProfile(absorption: Float, scattering: Float, eta: Float):
  private val extinction = absorption + scattering
  private val albedo = if extinction > 0f then scattering / extinction else 0f
  private val effective = sqrt(3f * absorption * extinction)

  /** Depth of the real source, and height of the virtual one. */
  private val (real, image) =
    val depth = 1f / extinction
    (depth, depth * (1f + DipoleProfile.imageShift(eta)))

  private val ofReal = 0.5f * albedo * exp(-effective * real)
  private val ofImage = 0.5f * albedo * exp(-effective * image)

  /** Diffuse reflectance of a semi-infinite medium. */
  val reflectance: Float =
    if extinction > 0f && extinction < Float.PositiveInfinity then ofReal + ofImage else 0f

  /** Radiant exitance at the distance `d`. */
  def apply(d: Float): Float =
    if reflectance > 0f then albedo * InvPi * 0.25f * (term(real, d) + term(image, d)) else 0f

  private def term(z: Float, r: Float): Float =
    val distance = sqrt(r * r + z * z)
    z * (1f + effective * distance) * exp(-effective * distance) / (distance * distance * distance)

  /** Inverts the cumulative energy of one of the two sources, each of which is integrable. Requires
    * `reflectance` > 0.
    */
  def sample(u: Float): Float =
    val fraction = ofReal / reflectance
    if u < fraction then radius(real, u / fraction)
    else radius(image, (u - fraction) / (1f - fraction))

  /** The fraction z/d·e^(−σ(d−z)) of the energy of a source at `z` exits farther than d from it. */
  private def radius(z: Float, u: Float): Float =
    val target = -Math.log1p(-Math.min(u, OneMinusEpsilon).toDouble)
    val steepness = effective.toDouble * z
    // x = log(d/z); Newton's method for a convex function, started past its root
    var x = if steepness > 0 then Math.min(target, Math.log1p(target / steepness)) else target
    var step = 1.0
    while step > 1e-7 do
      val growth = Math.exp(x)
      step = (x + steepness * (growth - 1) - target) / (1 + steepness * growth)
      x -= step
    (z * Math.sqrt(Math.max(0.0, Math.exp(2 * x) - 1))).toFloat

object DipoleProfile:
  /** Extra height of the virtual source, in depths of the real one. */
  private def imageShift(eta: Float): Float =
    val inner = FresnelMoments.diffuse(eta)
    4f / 3f * (1f + inner) / (1f - inner)

  /** Reduced albedo of the medium with this diffuse reflectance, by bisection. */
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

/** The dipole in three channels, with diffuse entry and exit.
  *
  * @param counted fraction of the surface that contributes
  */
final class DipoleBssrdf(
    r: DipoleProfile,
    g: DipoleProfile,
    b: DipoleProfile,
    val eta: Float,
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

  /** The same for all channels, since one channel's distant sample may be near the axis for the
    * others.
    */
  def reach(channel: Int): Float = farthest

  /** Accepts light from either side: in a closed body the inner side is dark. PBRT 2 selects the
    * side of the point at random.
    */
  val entry: Bsdf = DiffuseTransmission(Rgb.White, Rgb.White)

object DipoleBssrdf:
  /** Fraction within [[reach]]: the dipole falls off slowly at low absorption. */
  private inline val Reached = 0.9999f
