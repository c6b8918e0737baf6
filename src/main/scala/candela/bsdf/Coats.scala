package candela.bsdf

import candela.math.*
import java.util.concurrent.ConcurrentHashMap

/** Makes [[Coat]]s for a scene and hands the same one to all who ask for the same; thread-safe. */
final class Coats:
  private val made = ConcurrentHashMap[(TrowbridgeReitzKey, Float, Float), Coat]
  private val families = ConcurrentHashMap[(Float, Float), IArray[Coat]]

  private type TrowbridgeReitzKey = (Float, Float)

  /** The coat with this outer side, and this absorption in mean free paths. */
  def of(top: TrowbridgeReitz, eta: Float, thickness: Float): Coat =
    made.computeIfAbsent(
      ((top.alphaX, top.alphaY), eta, thickness),
      _ =>
        if top.isSmooth || eta == 1f then SmoothCoat(eta, thickness)
        else RoughCoat(top, eta, thickness)
    )

  /** Coats of isotropic roughnesses from 0 to 1, denser towards 0: for [[Coats.between]]. */
  def family(eta: Float, thickness: Float): IArray[Coat] =
    families.computeIfAbsent(
      (eta, thickness),
      _ =>
        IArray.tabulate(Coats.Levels): i =>
          val alpha = square(i.toFloat / (Coats.Levels - 1).toFloat)
          of(TrowbridgeReitz(alpha, alpha), eta, thickness)
    )

object Coats:

  /** How finely `family` divides the square root of the roughness. */
  inline val Levels = 33

  /** The coat of any roughness from 0 to 1, off by at most 0.003 (`CoatSuite`); for an anisotropic
    * one, that of the geometric mean.
    */
  def between(family: IArray[Coat], top: TrowbridgeReitz): Coat =
    val isotropic = top.alphaX == top.alphaY
    val root = if isotropic then sqrt(top.alphaX) else sqrt(sqrt(top.alphaX * top.alphaY))
    val level = clamp(root, 0f, 1f) * (Levels - 1).toFloat
    val i = Math.min(level.toInt, Levels - 2)
    BlendedCoat(family, top, i, level - i.toFloat)

/** A coat between two others of its family: `t` of the way from the `i`th to the next. */
private final class BlendedCoat(family: IArray[Coat], top: TrowbridgeReitz, i: Int, t: Float)
    extends Coat:
  private val a = family(i)
  private val b = family(i + 1)

  def eta: Float = a.eta
  def transmittance(w: Vec3): Float = lerp(t, a.transmittance(w), b.transmittance(w))
  def meanTransmittance: Float = lerp(t, a.meanTransmittance, b.meanTransmittance)
  def internalReflectance: Float = lerp(t, a.internalReflectance, b.internalReflectance)
  def regularized: Coat = Coats.between(family, top.regularized)
