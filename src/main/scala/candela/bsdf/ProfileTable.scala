package candela.bsdf

import candela.color.Rgb
import candela.math.*
import java.util.concurrent.ConcurrentHashMap

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
