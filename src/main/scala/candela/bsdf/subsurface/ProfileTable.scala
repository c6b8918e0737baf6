package candela.bsdf.subsurface

import java.util.concurrent.ConcurrentHashMap

import candela.bsdf.{Bsdf, Bssrdf, Fresnel}
import candela.color.Rgb
import candela.math.*

/** How light leaves a medium around the place where it entered, for media of all albedos; lengths
  * are in mean free paths.
  *
  * @param albedos rising from 0 to 1
  * @param radii   rising from 0
  * @param values  for each albedo the exitance at all radii r, times 2πr
  */
final class ProfileTable(albedos: Array[Float], radii: Array[Float], values: Array[Float]):

  /** The part of light that comes out again, for each albedo. */
  private val reflectances: Array[Float] =
    values.grouped(radii.length).map(CatmullRom.integrals(radii, _).last).toArray

  def profile(albedo: Float): RadialProfile =
    RadialProfile(radii, CatmullRom.row(albedos, values, albedo))

  /** Those of the three channels, each of its own albedo. */
  def profiles(albedos: Rgb): Array[RadialProfile] =
    Array(profile(albedos.r), profile(albedos.g), profile(albedos.b))

  /** The albedo of the medium that reflects this part of the light that entered. */
  def albedoOf(reflectance: Float): Float = CatmullRom.invert(albedos, reflectances, reflectance)

object ProfileTable:
  // How fine pbrt's tables are
  private inline val Albedos = 100
  private inline val Radii = 64
  private inline val SecondRadius = 0.0025f
  private inline val Growth = 1.2f
  private inline val AlbedoDecay = 8.0

  /** The table of [[BeamDiffusion]].
    *
    * Source of its nodes: PBRT 3rd ed., §15.5.4. They are dense where light spreads widely, which
    * is where the albedo is nearly 1.
    */
  def beamDiffusion(g: Float, eta: Float): ProfileTable =
    val albedos = Array.tabulate(Albedos): i =>
      ((1 - Math.exp(-AlbedoDecay * i / (Albedos - 1))) / (1 - Math.exp(-AlbedoDecay))).toFloat
    val radii = 0f +: Array.iterate(SecondRadius, Radii - 1)(_ * Growth)
    val values = new Array[Float](Albedos * Radii)
    for i <- 0 until Albedos do
      val medium = BeamDiffusion(1.0 - albedos(i), albedos(i), g, eta)
      for j <- 1 until Radii do
        val r = radii(j).toDouble
        val exitance = medium.single(r) + medium.multiple(r)
        values(i * Radii + j) = (2 * Math.PI * r * exitance).toFloat
    ProfileTable(albedos, radii, values)

/** One row of a [[ProfileTable]].
  *
  * @param values exitance times 2πr, at each of `radii`
  */
final class RadialProfile(radii: Array[Float], values: Array[Float]):
  private val sums = CatmullRom.integrals(radii, values)

  /** The part of light that comes out again. */
  val reflectance: Float = sums(sums.length - 1)

  /** Exitance at `r`. */
  def apply(r: Float): Float =
    if r > 0f then Math.max(0f, CatmullRom.value(radii, values, r) / (TwoPi * r)) else 0f

  /** The density of places, for each unit of area, that [[sample]] spreads around the centre. */
  def density(r: Float): Float = if reflectance > 0f then apply(r) / reflectance else 0f

  /** A radius that a part `u` of the light that leaves doesn't reach. */
  def sample(u: Float): Float =
    if reflectance > 0f then CatmullRom.sample(radii, values, sums, u) else 0f

/** Makes tables for a scene and hands the same one to all who ask for the same; thread-safe. */
final class ProfileTables:
  private val made = ConcurrentHashMap[(Float, Float), ProfileTable]

  /** That of [[ProfileTable.beamDiffusion]]; `g` is held to where scattering still spreads
    * light.
    */
  def of(g: Float, eta: Float): ProfileTable =
    made.computeIfAbsent(
      (clamp(g, -ProfileTables.Narrowest, ProfileTables.Narrowest), eta),
      key => ProfileTable.beamDiffusion(key._1, key._2)
    )

object ProfileTables:
  private inline val Narrowest = 0.999f

/** How a beam that enters a half-space of scattering medium along the normal comes out again: the
  * radiant exitance at distance `r`, for each unit of power. Photon beam diffusion.
  *
  * Source: Habel, Christensen, Jarosz, "Photon Beam Diffusion: A Hybrid Monte Carlo Method for
  * Subsurface Scattering", EGSR 2013; PBRT 3rd ed., §15.5.
  *
  * @param absorption coefficient
  * @param scattering coefficient
  * @param g          mean cosine of the angle of scattering, that of Henyey and Greenstein's phase
  *                   function
  * @param eta        index of refraction of the medium over that outside
  */
final class BeamDiffusion(absorption: Double, scattering: Double, g: Float, eta: Float):
  import BeamDiffusion.*

  private val extinction = absorption + scattering
  private val reducedScattering = scattering * (1 - g)
  private val reducedExtinction = absorption + reducedScattering
  private val reducedAlbedo = reducedScattering / reducedExtinction

  /** Grosjean's diffusion coefficient, good for low albedos, too. */
  private val diffusion =
    (2 * absorption + reducedScattering) / (3 * reducedExtinction * reducedExtinction)
  private val effective = Math.sqrt(absorption / diffusion)

  private val moment1 = FresnelMoments.first(eta).toDouble
  private val moment2 = FresnelMoments.second(eta).toDouble

  /** Where the fluence falls to 0, by linear extrapolation: above the surface. */
  private val zeroAt = -2 * diffusion * (1 + 3 * moment2) / (1 - 2 * moment1)
  private val fluencePart = 0.25 * (1 - 2 * moment1)
  private val fluxPart = 0.5 * (1 - 3 * moment2)

  /** What was scattered more than once: dipoles all along the beam. */
  def multiple(r: Double): Double =
    var sum = 0.0
    for i <- 0 until Steps do
      val real = depth(i, reducedExtinction)
      val mirrored = 2 * zeroAt - real
      val toReal = Math.hypot(r, real)
      val toMirrored = Math.hypot(r, mirrored)
      val near = Math.exp(-effective * toReal)
      val far = Math.exp(-effective * toMirrored)
      val fluence = InvFourPi / diffusion * (near / toReal - far / toMirrored)
      val flux = InvFourPi * (
        real * (1 + effective * toReal) * near / cube(toReal) -
          mirrored * (1 + effective * toMirrored) * far / cube(toMirrored)
      )
      // Close to the beam, where diffusion errs, light has rarely been scattered twice
      val correction = 1 - Math.exp(-2 * reducedExtinction * (toReal + real))
      sum += correction * (fluence * fluencePart + flux * fluxPart)
    reducedAlbedo * reducedAlbedo * sum / Steps

  /** What was scattered once. */
  def single(r: Double): Double =
    // From above this depth, light would be reflected back into the medium
    val least = r * Math.sqrt(Math.max(0.0, eta.toDouble * eta - 1))
    var sum = 0.0
    for i <- 0 until Steps do
      val t = least + depth(i, extinction)
      val way = Math.hypot(r, t)
      val cosine = t / way
      sum += Math.exp(-extinction * (way + least)) / (way * way) * phase(cosine) *
        (1 - Fresnel.dielectric(-cosine.toFloat, eta)) * cosine
    scattering / extinction * sum / Steps

  private def phase(cosine: Double): Double =
    val denominator = 1 + g * g + 2 * g * cosine
    InvFourPi * (1 - g * g) / (denominator * Math.sqrt(denominator))

object BeamDiffusion:
  private val InvFourPi = 1 / (4 * Math.PI)

  /** Points on the beam. */
  private inline val Steps = 100

  /** Spread like the free paths of a medium. */
  private def depth(i: Int, extinction: Double): Double =
    -Math.log(1 - (i + 0.5) / Steps) / extinction

  private def cube(x: Double) = x * x * x

/** A [[Bssrdf]] by profiles.
  *
  * @param profiles   of each channel
  * @param extinction coefficient, whose inverse is the unit of length of each profile
  * @param eta        index of refraction of the medium over that outside; what leaves has been
  *                   refracted by [[Dielectric]], which spreads radiance by its square
  */
final class TabulatedBssrdf(
    profiles: Array[RadialProfile],
    extinction: Rgb,
    eta: Float,
    val entry: Bsdf
) extends Bssrdf:
  private val perLength = Array(extinction.r, extinction.g, extinction.b)
  private val reaches =
    Array.tabulate(3)(c => length(c, profiles(c).sample(TabulatedBssrdf.Reached)))

  def apply(distance: Float): Rgb =
    Rgb(factor(0, distance), factor(1, distance), factor(2, distance)) * (eta * eta)

  private def factor(channel: Int, distance: Float): Float =
    val s = perLength(channel)
    if isClear(s) then 0f else profiles(channel)(distance * s) * s * s

  def density(radius: Float): Float =
    var sum = 0f
    var c = 0
    while c < 3 do
      val s = perLength(c)
      if !isClear(s) then sum += profiles(c).density(radius * s) * s * s
      c += 1
    sum * (1f / 3f)

  def sample(channel: Int, u: Float): Float = length(channel, profiles(channel).sample(u))

  def reach(channel: Int): Float = reaches(channel)

  private def length(channel: Int, freePaths: Float): Float =
    if isClear(perLength(channel)) then -1f else freePaths / perLength(channel)

  /** Nothing comes back from a medium that doesn't scatter, or from one without depth. */
  private def isClear(extinction: Float): Boolean =
    !(extinction > 0f) || extinction == Float.PositiveInfinity

object TabulatedBssrdf:
  /** A thousandth is left out, and more where other channels reach farther around a body: so in
    * PBRT 3rd ed., §15.4.1, and in pbrt.
    */
  private inline val Reached = 0.999f
