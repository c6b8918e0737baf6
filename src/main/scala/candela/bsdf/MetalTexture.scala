package candela.bsdf

import candela.geometry.ShadingPoint
import candela.textures.RgbTexture

/** How a metal reflects, at each point of a surface. */
abstract class MetalTexture:
  def apply(at: ShadingPoint): ReflectanceCurve
  def isConstant: Boolean

/** The same curve everywhere. */
final class UniformMetal(curve: ReflectanceCurve) extends MetalTexture:
  def apply(at: ShadingPoint): ReflectanceCurve = curve
  def isConstant: Boolean = true

/** A metal of varying complex index of refraction.
  *
  * @param outside index of the medium that it is in
  * @param strong  by the approximation for metals that absorb well
  */
final class IndexedMetal(
    eta: RgbTexture,
    k: RgbTexture,
    outside: Float = 1f,
    strong: Boolean = false
) extends MetalTexture:
  def apply(at: ShadingPoint): ReflectanceCurve =
    val n = eta(at) * (1f / outside)
    val a = k(at) * (1f / outside)
    if strong then StrongConductorReflectance(n, a) else ConductorReflectance(n, a)
  def isConstant: Boolean = eta.constant.isDefined && k.constant.isDefined

/** A metal given by what it would reflect at normal incidence, were it outside.
  *
  * @param outside index of the medium that it is in
  */
final class TintedMetal(reflectance: RgbTexture, outside: Float = 1f) extends MetalTexture:
  def apply(at: ShadingPoint): ReflectanceCurve =
    ConductorReflectance.ofReflectance(reflectance(at), outside)
  def isConstant: Boolean = reflectance.constant.isDefined
