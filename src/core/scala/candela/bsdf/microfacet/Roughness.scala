package candela.bsdf.microfacet

import candela.bsdf.MaterialFlags
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, FloatTexture, Textured}

/** Interpretation of a scene's roughness values; differs between the versions of PBRT. */
enum RoughnessModel:

  /** Version 2: the exponent of Blinn's distribution is 1/u; v is not used. */
  case BlinnExponent

  /** Version 2, layered surfaces: the exponents along x and y are 1/u and 1/v. */
  case AnisotropicExponents

  /** Version 3: [[TrowbridgeReitz]] with `alpha` from [[Roughness.polynomialAlpha]]. */
  case PolynomialAlpha

  /** Version 3 without remapping: `alpha` itself, at least 0.001. */
  case BoundedAlpha

  /** Version 4: `alpha` is the square root of the roughness. */
  case SquareRootAlpha

  /** Version 4 without remapping: `alpha` itself. */
  case PlainAlpha

  /** Mitsuba, `ggx`: `alpha` itself. */
  case SeparableGgx

  /** Mitsuba, `beckmann`: `alpha` itself. */
  case Gaussian

  /** Mitsuba 0.6, `phong`: `alpha` itself. */
  case CosineAlpha

  def distribution(u: Float, v: Float): MicrofacetDistribution = this match
    case BlinnExponent => CosinePower(1f / u)
    case AnisotropicExponents => new CosinePower(1f / u, 1f / v)
    case SeparableGgx => plain(u, v, SeparableTrowbridgeReitz(_, _))
    case Gaussian => plain(u, v, Beckmann(_, _))
    case CosineAlpha => plain(u, v, CosineFacets(_, _))
    case _ => trowbridgeReitz(u, v)

  private def plain(
      u: Float,
      v: Float,
      rough: (Float, Float) => MicrofacetDistribution
  ): MicrofacetDistribution =
    val smooth = trowbridgeReitz(u, v)
    if smooth.isSmooth then smooth else rough(smooth.alphaX, smooth.alphaY)

  /** The Trowbridge–Reitz distribution, for surfaces that support no other. An exponent e maps to
    * the `alpha` of equal core width, √(2/(e + 2)) (Walter et al. 2007, §5.2).
    */
  def trowbridgeReitz(u: Float, v: Float): TrowbridgeReitz = TrowbridgeReitz(alpha(u), alpha(v))

  private def alpha(roughness: Float): Float = this match
    case BlinnExponent | AnisotropicExponents => sqrt(2f / (1f / Math.max(roughness, 1e-4f) + 2f))
    case PolynomialAlpha => Math.max(Roughness.polynomialAlpha(roughness), 1e-3f)
    case BoundedAlpha => Math.max(roughness, 1e-3f)
    case SquareRootAlpha => safeSqrt(roughness)
    case PlainAlpha | SeparableGgx | Gaussian | CosineAlpha => Math.max(roughness, 0f)

/** Textured roughness.
  *
  * @param u            along ∂p/∂u, in the unit of the model
  * @param v            along ∂p/∂v
  * @param smoothAtZero if true, roughness 0 in both directions is a perfect mirror even if the
  *                     model would make it slightly rough (the glass of PBRT 3)
  */
final class Roughness(
    u: FloatTexture,
    v: FloatTexture,
    model: RoughnessModel,
    smoothAtZero: Boolean = false
) extends Textured(u, v):
  override val isAnisotropic: Boolean = (u.constant, v.constant) match
    case (Some(a), Some(b)) => a != b && model != RoughnessModel.BlinnExponent
    case _ => !(u eq v)

  // Valid only if the roughness is constant.
  private val fixedU = u.constant.getOrElse(1f)
  private val fixedV = v.constant.getOrElse(1f)
  private val fixed = evaluate(fixedU, fixedV)
  private val fixedTrowbridgeReitz = model.trowbridgeReitz(fixedU, fixedV)

  def apply(at: ShadingPoint): MicrofacetDistribution =
    if isConstant then fixed else evaluate(u(at), v(at))

  /** Equal for equal distributions at the point. */
  def key(at: ShadingPoint): (RoughnessModel, Boolean, Float, Float) =
    (model, smoothAtZero, u(at), v(at))

  /** The Trowbridge–Reitz distribution, for surfaces that support no other. */
  def trowbridgeReitz(at: ShadingPoint): TrowbridgeReitz =
    if isConstant then fixedTrowbridgeReitz else model.trowbridgeReitz(u(at), v(at))

  /** Flags of a material that scatters light by such microfacets alone. */
  def flags: MaterialFlags =
    if isConstant && !fixed.isNarrow then MaterialFlags.Plain else MaterialFlags.Caster

  /** Whether the surface is smooth everywhere. */
  def isSmooth: Boolean = isConstant && fixedTrowbridgeReitz.isSmooth

  private def evaluate(ru: Float, rv: Float): MicrofacetDistribution =
    if smoothAtZero && ru == 0f && rv == 0f then TrowbridgeReitz(0f, 0f)
    else model.distribution(ru, rv)

object Roughness:
  val Smooth: Roughness =
    Roughness(ConstantFloat(0f), ConstantFloat(0f), RoughnessModel.PlainAlpha)

  /** PBRT 3's `alpha` for a roughness in [0, 1]: a fit to a perceptually uniform scale.
    *
    * Source: PBRT 3rd ed., §8.4.5; Jakob, "Mitsuba renderer".
    */
  def polynomialAlpha(roughness: Float): Float =
    val x = log(Math.max(roughness, 1e-3f))
    1.62142f + x * (0.819955f + x * (0.1734f + x * (0.0171201f + x * 0.000640711f)))
