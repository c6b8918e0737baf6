package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture}

/** PBRT 2's medium by its coefficients, textures times `scale`, in 1/scene unit.
  *
  * @param scattering reduced
  * @param eta        index of refraction inside over that outside
  * @param counted    see [[DipoleBssrdf]]
  */
final class DipoleInterior(
    absorption: RgbTexture,
    scattering: RgbTexture,
    scale: Float,
    eta: FloatTexture,
    counted: Float
) extends Interior:
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

/** PBRT 2's medium by what it reflects.
  *
  * @param meanFreePath the inverse of the effective transport coefficient, in scene units
  */
final class DiffuseDipoleInterior(
    reflectance: RgbTexture,
    meanFreePath: FloatTexture,
    eta: FloatTexture,
    counted: Float
) extends Interior:
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
