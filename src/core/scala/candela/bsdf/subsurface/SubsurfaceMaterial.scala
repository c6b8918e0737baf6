package candela.bsdf.subsurface

import candela.bsdf.{Bsdf, Bssrdf, Material, MaterialFlags}
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Textured, Varying}

/** A surface with subsurface scattering.
  *
  * @param surface       material of the boundary
  * @param alongTangents if true, probe rays follow the tangents of u and v, as in pbrt-v3;
  *                      otherwise any tangents. This affects which distant light is truncated (see
  *                      [[Bssrdf.reach]])
  */
final class SubsurfaceMaterial(
    surface: Material,
    beneath: Interior,
    alongTangents: Boolean = false
) extends Material,
      Textured(surface, beneath):
  private val boundary = surface.folded.resolved
  private val interior = beneath.folded

  def bsdf(at: ShadingPoint): Bsdf = boundary.bsdf(at)
  override def bssrdf(at: ShadingPoint): Bssrdf | Null = interior.bssrdf(at)
  override def flags: MaterialFlags = surface.flags | MaterialFlags.Subsurface
  override def isAnisotropic: Boolean = alongTangents || boundary.isAnisotropic

/** Evaluates the [[Bssrdf]] at surface points; null where there is none. */
abstract class Interior extends Varying:
  def bssrdf(at: ShadingPoint): Bssrdf | Null

  /** As [[Material.folded]]. */
  def folded: Interior = if isConstant then ConstantInterior(bssrdf(ShadingPoint())) else this

/** One [[Bssrdf]] everywhere. */
private final class ConstantInterior(value: Bssrdf | Null) extends Interior:
  def isConstant: Boolean = true
  def bssrdf(at: ShadingPoint): Bssrdf | Null = value

/** A medium given by its coefficients in 1/scene unit; textures times `scale` are clamped to ≥ 0.
  *
  * @param table for the medium's index of refraction, `eta`
  */
final class CoefficientInterior(
    table: ProfileTable,
    absorption: RgbTexture,
    scattering: RgbTexture,
    scale: Float,
    eta: Float
) extends Interior,
      Textured(absorption, scattering):
  private val entry = NormalizedFresnel(eta)

  def bssrdf(at: ShadingPoint): Bssrdf =
    val sigmaA = absorption(at).map(c => Math.max(scale * c, 0f))
    val sigmaS = scattering(at).map(c => Math.max(scale * c, 0f))
    val extinction = sigmaA + sigmaS
    // NaN (0/0) without extinction, which is not above 0
    val albedos = (sigmaS / extinction).map(a => if a > 0f then a else 0f)
    TabulatedBssrdf(table.profiles(albedos), extinction, eta, entry)

/** A medium given by its reflectance; `meanFreePath` times `scale` is in scene units.
  *
  * @param table for the medium's index of refraction, `eta`
  */
final class ReflectanceInterior(
    table: ProfileTable,
    reflectance: RgbTexture,
    meanFreePath: RgbTexture,
    scale: Float,
    eta: Float
) extends Interior,
      Textured(reflectance, meanFreePath):
  private val entry = NormalizedFresnel(eta)

  def bssrdf(at: ShadingPoint): Bssrdf =
    val extinction = meanFreePath(at).map(c => 1f / Math.max(scale * c, 0f))
    val albedos = reflectance(at).map(table.albedoOf(_))
    TabulatedBssrdf(table.profiles(albedos), extinction, eta, entry)

/** PBRT 2's medium given by its coefficients: textures times `scale`, in 1/scene unit.
  *
  * @param scattering reduced scattering coefficient
  * @param eta        index of refraction inside over that outside
  * @param counted    see [[DipoleBssrdf]]
  */
final class DipoleInterior(
    absorption: RgbTexture,
    scattering: RgbTexture,
    scale: Float,
    eta: FloatTexture,
    counted: Float
) extends Interior,
      Textured(absorption, scattering, eta):
  def bssrdf(at: ShadingPoint): Bssrdf =
    val sigmaA = absorption(at).map(c => Math.max(scale * c, 0f))
    val sigmaS = scattering(at).map(c => Math.max(scale * c, 0f))
    val index = eta(at)
    DipoleBssrdf(
      DipoleProfile(sigmaA.r, sigmaS.r, index),
      DipoleProfile(sigmaA.g, sigmaS.g, index),
      DipoleProfile(sigmaA.b, sigmaS.b, index),
      index,
      counted
    )

/** PBRT 2's medium given by its reflectance.
  *
  * @param meanFreePath inverse of the effective transport coefficient, in scene units
  */
final class DiffuseDipoleInterior(
    reflectance: RgbTexture,
    meanFreePath: FloatTexture,
    eta: FloatTexture,
    counted: Float
) extends Interior,
      Textured(reflectance, meanFreePath, eta):
  def bssrdf(at: ShadingPoint): Bssrdf =
    val index = eta(at)
    val path = meanFreePath(at)
    val color = reflectance(at)
    DipoleBssrdf(
      profile(color.r, path, index),
      profile(color.g, path, index),
      profile(color.b, path, index),
      index,
      counted
    )

  private def profile(reflectance: Float, path: Float, eta: Float): DipoleProfile =
    val albedo = DipoleProfile.albedoOf(Math.max(reflectance, 0f), eta)
    val extinction = 1f / (Math.max(path, 0f) * sqrt(3f * (1f - albedo)))
    DipoleProfile((1f - albedo) * extinction, albedo * extinction, eta)
