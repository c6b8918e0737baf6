package candela.bsdf

import candela.color.{ColorBasis, Rgb}
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Varying}

/** What colours a hair. */
enum Pigment extends Varying:
  /** The absorption coefficient itself, per unit of the hair's radius. */
  case Absorption(sigmaA: RgbTexture)

  /** The colour that a head of such hair has. */
  case Color(reflectance: RgbTexture)

  /** Concentrations of the pigments that colour it black and brown, and red. */
  case Melanin(eumelanin: FloatTexture, pheomelanin: FloatTexture, basis: ColorBasis)

  def absorption(at: ShadingPoint, betaN: Float): Rgb = this match
    case Absorption(sigmaA) => sigmaA.positive(at)
    case Color(reflectance) => Pigment.ofColor(reflectance(at), betaN)
    case Melanin(eu, pheo, basis) =>
      val e = Math.max(eu(at), 0f)
      val p = Math.max(pheo(at), 0f)
      basis.fromSrgb(Pigment.Eumelanin * e + Pigment.Pheomelanin * p).map(s => Math.max(s, 0f))

  def isConstant: Boolean = this match
    case Absorption(t) => t.isConstant
    case Color(t) => t.isConstant
    case Melanin(e, p, _) => e.isConstant && p.isConstant

object Pigment:
  // Absorption of a unit concentration; source: d'Eon et al., EGSR 2011, as given in PBRT
  private val Eumelanin = Rgb(0.419f, 0.697f, 1.37f)
  private val Pheomelanin = Rgb(0.187f, 0.4f, 1.05f)

  /** The absorption of hair that looks like `color`, roughness `n` around (Chiang et al. 2016,
    * §4.2).
    */
  private[bsdf] def ofColor(color: Rgb, n: Float): Rgb =
    val fit = 5.969f + n * (-0.215f + n * (2.532f + n * (-10.73f + n * (5.574f + n * 0.245f))))
    color.map(c => square(log(clamp(c, 1e-4f, 1f)) / fit))

/** [[Hair]] on a curve, whose v says where across the width the ray meets it. */
final class HairMaterial(
    pigment: Pigment,
    eta: FloatTexture,
    betaM: FloatTexture,
    betaN: FloatTexture,
    alpha: FloatTexture
) extends Material:
  private val fixedShape =
    for m <- betaM.constant; n <- betaN.constant; a <- alpha.constant yield HairShape(m, n, a)
  private val fixedAbsorption =
    for n <- betaN.constant if pigment.isConstant yield pigment.absorption(ShadingPoint(), n)

  def bsdf(at: ShadingPoint): Bsdf =
    val shape = fixedShape match
      case Some(s) => s
      case None => HairShape(betaM(at), betaN(at), alpha(at))
    val sigmaA = fixedAbsorption match
      case Some(s) => s
      case None => pigment.absorption(at, betaN(at))
    Hair(clamp(2f * at.v - 1f, -1f, 1f), eta(at), sigmaA, shape)

  override def isAnisotropic: Boolean = true
