package candela.aov

import candela.color.{ColorBasis, Rgb}
import candela.film.SampleLimit
import candela.lights.LightGroups

import java.util.Arrays

/** The light of one sample, divided in two ways: by the number of scattering events between light
  * and camera, and by the group of the light. Mutable, one per worker; integrators fill it, layers
  * read it.
  */
final class LightParts(val groups: LightGroups):
  import LightParts.*

  private val sums = new Array[Float](3 * (Groups + groups.names.size))
  private var glow = Rgb.Black

  /** Starts a sample. */
  def clear(): Unit =
    Arrays.fill(sums, 0f)
    glow = Rgb.Black

  def apply(part: Int): Rgb = Rgb(sums(3 * part), sums(3 * part + 1), sums(3 * part + 2))

  /** Adds light of a surface or a light sample, after `depth` scattering events. */
  def addLight(light: Int, depth: Int, found: Rgb): Unit =
    add(Emission, groups(light), depth, found)

  /** Adds light of an infinite light that a path has met. */
  def addEnvironment(light: Int, depth: Int, found: Rgb): Unit =
    add(Background, groups(light), depth, found)

  /** Adds light that media emit. */
  def addGlow(depth: Int, found: Rgb): Unit =
    if groups.ofMedia >= 0 then add(Emission, groups.ofMedia, depth, found)

  /** Adds what media have emitted since the last call, given the sum so far. */
  def addGlowUpTo(depth: Int, sum: Rgb): Unit =
    addGlow(depth, Rgb(sum.r - glow.r, sum.g - glow.g, sum.b - glow.b))
    glow = sum

  /** Adds light of a group that the integrator itself tells apart. */
  def addToGroup(group: Int, found: Rgb): Unit = add(Groups + group, found)

  /** Adds light to a part alone, but not to a group. */
  def addEmission(found: Rgb): Unit = add(Emission, found)

  private def add(unscattered: Int, group: Int, depth: Int, found: Rgb): Unit =
    add(if depth == 0 then unscattered else if depth == 1 then Direct else Indirect, found)
    add(Groups + group, found)

  private def add(part: Int, found: Rgb): Unit =
    sums(3 * part) += found.r
    sums(3 * part + 1) += found.g
    sums(3 * part + 2) += found.b

  /** Becomes those of another sample, whose colours are in a basis. */
  def convert(from: LightParts, basis: ColorBasis): Unit =
    var index = 0
    while 3 * index < sums.length do
      val color = basis.toSrgb(from(index))
      sums(3 * index) = color.r
      sums(3 * index + 1) = color.g
      sums(3 * index + 2) = color.b
      index += 1

  def scale(factor: Float): Unit = scale(0, sums.length, factor)

  private def scale(from: Int, until: Int, factor: Float): Unit =
    var i = from
    while i < until do
      sums(i) *= factor
      i += 1

  /** Limits the light scattered more than once; all groups of lights lose alike.
    *
    * @param weight of the sample, which the limit includes
    * @return the light of all parts
    */
  def limit(sampleLimit: SampleLimit, weight: Float): Rgb =
    val unlimited = this(Emission) + this(Background) + this(Direct)
    val indirect = this(Indirect)
    val factor = sampleLimit.scale(indirect * weight)
    val limited = unlimited + indirect * factor
    val largest = (unlimited + indirect).largest
    scale(3 * Indirect, 3 * Indirect + 3, factor)
    if largest > 0f then scale(3 * Groups, sums.length, limited.largest / largest)
    limited

object LightParts:
  /** Light that reaches the camera unscattered, of surfaces and media, and of infinite lights. */
  inline val Emission = 0
  inline val Background = 1

  /** Light scattered once, by a surface or a medium; and more often. */
  inline val Direct = 2
  inline val Indirect = 3

  /** The first group of lights. */
  inline val Groups = 4
