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

  /** Coats of `Coats.Levels` isotropic roughnesses, equally spaced from 0 to 1. */
  def family(eta: Float, thickness: Float): IArray[Coat] =
    families.computeIfAbsent(
      (eta, thickness),
      _ =>
        IArray.tabulate(Coats.Levels): i =>
          val alpha = i.toFloat / (Coats.Levels - 1).toFloat
          of(TrowbridgeReitz(alpha, alpha), eta, thickness)
    )

object Coats:

  /** How finely `family` divides roughness: between neighbours, coats differ by less than 0.01
    * (`CoatSuite`).
    */
  inline val Levels = 65

  /** The member of a `family` nearest to a roughness; of an anisotropic one the geometric mean counts. */
  def nearest(family: IArray[Coat], top: TrowbridgeReitz): Coat =
    val alpha = if top.alphaX == top.alphaY then top.alphaX else sqrt(top.alphaX * top.alphaY)
    family(clamp(Math.round(alpha * (Levels - 1).toFloat), 0, Levels - 1))
