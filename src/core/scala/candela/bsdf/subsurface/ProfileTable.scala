package candela.bsdf.subsurface

import java.util.concurrent.ConcurrentHashMap

import candela.bsdf.{Bsdf, Bssrdf, Fresnel}
import candela.color.Rgb
import candela.math.*

/** Tabulated scattering profiles for all albedos; lengths are in mean free paths.
  *
  * @param albedos ascending from 0 to 1
  * @param radii   ascending from 0
  * @param values  for each albedo the radiant exitance at all radii r, times 2πr
  */
final class ProfileTable(albedos: Array[Float], radii: Array[Float], values: Array[Float]):

  /** Effective albedo (reflectance) by single-scattering albedo. */
  private val reflectances: Array[Float] =
    values.grouped(radii.length).map(CatmullRom.integrals(radii, _).last).toArray

  def profile(albedo: Float): RadialProfile =
    RadialProfile(radii, CatmullRom.row(albedos, values, albedo))

  /** Profiles of the three channels, each with its own albedo. */
  def profiles(albedos: Rgb): Array[RadialProfile] =
    Array(profile(albedos.r), profile(albedos.g), profile(albedos.b))

  /** Single-scattering albedo of the medium with this effective albedo. */
  def albedoOf(reflectance: Float): Float = CatmullRom.invert(albedos, reflectances, reflectance)

object ProfileTable:
  // Resolution of pbrt's tables
  private inline val Albedos = 100
  private inline val Radii = 64
  private inline val SecondRadius = 0.0025f
  private inline val Growth = 1.2f
  private inline val AlbedoDecay = 8.0

  /** The table of [[BeamDiffusion]].
    *
    * Source of its nodes: PBRT 3rd ed., §15.5.4. They are dense where the profile is wide, at
    * albedos near 1.
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
  * @param values radiant exitance times 2πr, at each of `radii`
  */
final class RadialProfile(radii: Array[Float], values: Array[Float]):
  private val sums = CatmullRom.integrals(radii, values)

  /** Effective albedo. */
  val reflectance: Float = sums(sums.length - 1)

  /** Radiant exitance at `r`. */
  def apply(r: Float): Float =
    if r > 0f then Math.max(0f, CatmullRom.value(radii, values, r) / (TwoPi * r)) else 0f

  /** The pdf of [[sample]] with respect to area. */
  def density(r: Float): Float = if reflectance > 0f then apply(r) / reflectance else 0f

  /** Samples a radius by inverting the cumulative profile. */
  def sample(u: Float): Float =
    if reflectance > 0f then CatmullRom.sample(radii, values, sums, u) else 0f

/** Creates and caches the tables of a scene. Thread-safe. */
final class ProfileTables:
  private val tables = ConcurrentHashMap[(Float, Float), ProfileTable]

  /** The cached [[ProfileTable.beamDiffusion]]; `g` is clamped to where the medium still diffuses.
    */
  def of(g: Float, eta: Float): ProfileTable =
    tables.computeIfAbsent(
      (clamp(g, -ProfileTables.Narrowest, ProfileTables.Narrowest), eta),
      key => ProfileTable.beamDiffusion(key._1, key._2)
    )

object ProfileTables:
  private inline val Narrowest = 0.999f

/** Photon beam diffusion: radiant exitance of a scattering half-space at distance `r` from a beam
  * of unit power at normal incidence.
  *
  * Source: Habel, Christensen, Jarosz, "Photon Beam Diffusion: A Hybrid Monte Carlo Method for
  * Subsurface Scattering", EGSR 2013; PBRT 3rd ed., §15.5.
  *
  * @param absorption absorption coefficient
  * @param scattering scattering coefficient
  * @param g          asymmetry of the Henyey–Greenstein phase function
  * @param eta        index of refraction of the medium over that outside
  */
final class BeamDiffusion(absorption: Double, scattering: Double, g: Float, eta: Float):
  import BeamDiffusion.*

  private val extinction = absorption + scattering
  private val reducedScattering = scattering * (1 - g)
  private val reducedExtinction = absorption + reducedScattering
  private val reducedAlbedo = reducedScattering / reducedExtinction

  /** Grosjean's diffusion coefficient, accurate for low albedos, too. */
  private val diffusion =
    (2 * absorption + reducedScattering) / (3 * reducedExtinction * reducedExtinction)
  private val effective = Math.sqrt(absorption / diffusion)

  private val moment1 = FresnelMoments.first(eta).toDouble
  private val moment2 = FresnelMoments.second(eta).toDouble

  /** Height at which the linearly extrapolated fluence vanishes: above the surface. */
  private val zeroAt = -2 * diffusion * (1 + 3 * moment2) / (1 - 2 * moment1)
  private val fluencePart = 0.25 * (1 - 2 * moment1)
  private val fluxPart = 0.5 * (1 - 3 * moment2)

  /** Multiple scattering: dipoles along the beam. */
  def multiple(r: Double): Double =
    var sum = 0.0
    for i <- 0 until Steps do
      val real = depth(i, reducedExtinction)
      val mirrored = 2 * zeroAt - real
      val toReal = Math.hypot(r, real)
      val toMirrored = Math.hypot(r, mirrored)
      val realDecay = Math.exp(-effective * toReal)
      val mirroredDecay = Math.exp(-effective * toMirrored)
      val fluence = InvFourPi / diffusion * (realDecay / toReal - mirroredDecay / toMirrored)
      val flux = InvFourPi * (
        real * (1 + effective * toReal) * realDecay / cube(toReal) -
          mirrored * (1 + effective * toMirrored) * mirroredDecay / cube(toMirrored)
      )
      // Near the beam diffusion overestimates: light has rarely scattered twice
      val correction = 1 - Math.exp(-2 * reducedExtinction * (toReal + real))
      sum += correction * (fluence * fluencePart + flux * fluxPart)
    reducedAlbedo * reducedAlbedo * sum / Steps

  /** Single scattering. */
  def single(r: Double): Double =
    // Above this depth, total internal reflection
    val minDepth = r * Math.sqrt(Math.max(0.0, eta.toDouble * eta - 1))
    var sum = 0.0
    for i <- 0 until Steps do
      val t = minDepth + depth(i, extinction)
      val distance = Math.hypot(r, t)
      val cosine = t / distance
      sum += Math.exp(-extinction * (distance + minDepth)) / (distance * distance) * phase(cosine) *
        (1 - Fresnel.dielectric(-cosine.toFloat, eta)) * cosine
    scattering / extinction * sum / Steps

  private def phase(cosine: Double): Double =
    val denominator = 1 + g * g + 2 * g * cosine
    InvFourPi * (1 - g * g) / (denominator * Math.sqrt(denominator))

object BeamDiffusion:
  private val InvFourPi = 1 / (4 * Math.PI)

  /** Number of points on the beam. */
  private inline val Steps = 100

  /** Depth of point `i`, distributed like the free paths of a medium. */
  private def depth(i: Int, extinction: Double): Double =
    -Math.log(1 - (i + 0.5) / Steps) / extinction

  private def cube(x: Double) = x * x * x

/** A [[Bssrdf]] of tabulated radial profiles.
  *
  * @param profiles   of each channel
  * @param extinction extinction coefficient, whose inverse is each profile's unit of length
  * @param eta        index of refraction of the medium over that outside. Exiting light is
  *                   refracted by [[Dielectric]], which divides radiance by its square
  */
final class TabulatedBssrdf(
    profiles: Array[RadialProfile],
    extinction: Rgb,
    val eta: Float,
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

  /** Whether the medium returns no light: no scattering, or no depth. */
  private def isClear(extinction: Float): Boolean =
    !(extinction > 0f) || extinction == Float.PositiveInfinity

object TabulatedBssrdf:
  /** Truncates a thousandth of the energy, and more where other channels reach farther around a
    * body: as in PBRT 3rd ed., §15.4.1, and in pbrt.
    */
  private inline val Reached = 0.999f
