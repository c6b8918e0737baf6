package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{FloatTexture, RgbTexture}

/** A surface that light enters, and leaves elsewhere.
  *
  * @param boundary      what the surface itself does
  * @param alongTangents is light searched for along the tangents of u and v, as in pbrt-v3? Other
  *                      programs take any. Which part of the light that went farthest is left out
  *                      depends on it (see [[Bssrdf.reach]])
  */
final class SubsurfaceMaterial(
    boundary: Material,
    interior: Interior,
    alongTangents: Boolean = false
) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = boundary.bsdf(at)
  override def bssrdf(at: ShadingPoint): Bssrdf | Null = interior.bssrdf(at)
  override def isSubsurface: Boolean = true
  override def isConstant: Boolean = boundary.isConstant && interior.isConstant
  override def isAnisotropic: Boolean = alongTangents || boundary.isAnisotropic

/** A smooth surface that reflects as an interface of index `eta` does, times `kr`, and lets nothing
  * through that goes on straight: so where PBRT 2 has something beneath.
  */
final class ReflectingInterfaceMaterial(kr: RgbTexture, eta: FloatTexture) extends Material:
  def bsdf(at: ShadingPoint): Bsdf =
    val scale = kr(at).map(c => Math.max(c, 0f))
    if scale.isBlack then ReflectingInterfaceMaterial.dark
    else Mirror(scale, DielectricReflectance(eta(at)))

object ReflectingInterfaceMaterial:
  private val dark = Lambert(Rgb.Black)

/** Gives every point the [[Bssrdf]] of what is beneath; null: nothing is there. */
abstract class Interior:
  def bssrdf(at: ShadingPoint): Bssrdf | Null

  /** Is it the same everywhere? */
  def isConstant: Boolean = false

/** The same everywhere: the object is made once, at build. */
final class ConstantInterior(value: Bssrdf | Null) extends Interior:
  def bssrdf(at: ShadingPoint): Bssrdf | Null = value
  override def isConstant: Boolean = true

object Interior:
  /** No texture looks at the point if all are constant. */
  def fold(interior: Interior, isFixed: Boolean): Interior =
    if isFixed then ConstantInterior(interior.bssrdf(ShadingPoint())) else interior

/** A medium by its coefficients; textures times `scale` are held to be at least 0, in 1/scene unit.
  *
  * @param table of the medium's index of refraction, which is `eta`
  */
final class CoefficientInterior(
    table: ProfileTable,
    absorption: RgbTexture,
    scattering: RgbTexture,
    scale: Float,
    eta: Float
) extends Interior:
  private val entry = NormalizedFresnel(eta)

  def bssrdf(at: ShadingPoint): Bssrdf =
    val sigmaA = absorption(at).map(c => Math.max(scale * c, 0f))
    val sigmaS = scattering(at).map(c => Math.max(scale * c, 0f))
    val extinction = sigmaA + sigmaS
    // Without extinction 0/0, which is not above 0
    val albedos = (sigmaS / extinction).map(a => if a > 0f then a else 0f)
    TabulatedBssrdf(table.profiles(albedos), extinction, eta, entry)

/** A medium by what it reflects; `meanFreePath` times `scale` in scene units.
  *
  * @param table as above
  */
final class ReflectanceInterior(
    table: ProfileTable,
    reflectance: RgbTexture,
    meanFreePath: RgbTexture,
    scale: Float,
    eta: Float
) extends Interior:
  private val entry = NormalizedFresnel(eta)

  def bssrdf(at: ShadingPoint): Bssrdf =
    val extinction = meanFreePath(at).map(c => 1f / Math.max(scale * c, 0f))
    val albedos = reflectance(at).map(table.albedoOf(_))
    TabulatedBssrdf(table.profiles(albedos), extinction, eta, entry)
