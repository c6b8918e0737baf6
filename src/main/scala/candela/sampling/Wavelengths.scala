package candela.sampling

import candela.color.{ColorBasis, Colorimetry, Rgb}
import candela.math.*

/** Samples a single wavelength for a path after dispersion, and returns that wavelength's
  * contribution to the path's colour.
  *
  * The responses sum to white: a path that does not depend on wavelength keeps its colour on
  * average. They are those of the CIE 1931 observer under D65, for which the components of a colour
  * scale white; in bins of 5 nm, uniformly sampled within. Single responses may be negative.
  *
  * @param basis colour basis in which light is multiplied
  */
final class Wavelengths(basis: ColorBasis):
  private val bins = Colorimetry.responses
  private val responses: Array[Rgb] =
    val raw = bins.map((_, c) => basis.fromSrgb(c))
    val white = raw.reduce(_ + _)
    raw.map(_ / white)
  private val sizes = responses.map(_.map(Math.abs(_)).max)
  private val pick = Discrete(sizes)

  /** The wavelength for `u` in [0, 1), in nm. */
  def sample(u: Float): Float =
    val bin = pick.sample(u)
    val middle = bins(bin)._1
    clamp(middle + 5f * (pick.remapped(u, bin) - 0.5f), bins.head._1, bins.last._1)

  /** Colour weight for `u`: the response over the probability of its bin. */
  def weight(u: Float): Rgb =
    val bin = pick.sample(u)
    responses(bin) * (1f / pick.probability(bin))
