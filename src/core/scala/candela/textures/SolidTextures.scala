package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** Fractional Brownian motion: clouds. */
final class FbmTexture(mapping: Mapping3D, octaves: Int, omega: Float) extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    Octaves.fbm(mapping(at), mapping.footprintSquared(at), omega, octaves, mapping.far)

/** Turbulence: creases, as in wrinkled skin. `evenMean` as for [[Octaves.turbulence]]. */
final class WrinkledTexture(mapping: Mapping3D, octaves: Int, omega: Float, evenMean: Boolean)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val footprint = mapping.footprintSquared(at)
    Octaves.turbulence(mapping(at), footprint, omega, octaves, evenMean, mapping.far)

/** Waves with an amplitude of coarser noise: water under gusts of wind. */
final class WindyTexture(mapping: Mapping3D) extends FloatTexture:
  private val far = mapping.far
  private val coarse = far * 0.1f
  def apply(at: ShadingPoint): Float =
    val p = mapping(at)
    val footprint = mapping.footprintSquared(at)
    val wind = Octaves.fbm(p * 0.1f, footprint * 0.01f, 0.5f, 3, coarse)
    abs(wind) * Octaves.fbm(p, footprint, 0.5f, 6, far)

/** Layers along y, perturbed by noise, in the colours of grey marble (linear sRGB).
  *
  * @param variation  amplitude of the perturbation
  * @param lastCurve  last of the six colour spline segments in use: 1 in pbrt-v3, which
  *   extrapolates it, 5 in the others
  *
  * Source: PBRT 3rd ed., §10.6.6.
  */
final class MarbleTexture(
    mapping: Mapping3D,
    octaves: Int,
    omega: Float,
    scale: Float,
    variation: Float,
    lastCurve: Int
) extends RgbTexture:
  private val far = mapping.far * scale

  def apply(at: ShadingPoint): Rgb =
    val p = mapping(at) * scale
    val footprint = mapping.footprintSquared(at) * square(scale)
    val layer = p.y + variation * Octaves.fbm(p, footprint, omega, octaves, far)
    val along = (0.5f + 0.5f * Math.sin(layer + far.y).toFloat) * MarbleColors.Curves
    val curve = Math.min(along.toInt, lastCurve)
    MarbleColors.bezier(curve, along - curve)

private object MarbleColors:
  private val grey = Rgb(0.58f, 0.58f, 0.6f)
  private val vein = Rgb(0.2f, 0.2f, 0.33f)
  private val colors = Array(
    grey,
    grey,
    grey,
    Rgb.gray(0.5f),
    Rgb(0.6f, 0.59f, 0.58f),
    grey,
    grey,
    vein,
    grey
  )
  val Curves: Int = colors.length - 3

  /** Brightens the colours, following pbrt; the result is never negative. */
  private val Brightness = 1.5f

  def bezier(first: Int, t: Float): Rgb =
    val s = 1f - t
    val sum = colors(first) * (s * s * s) + colors(first + 1) * (3f * s * s * t) +
      colors(first + 2) * (3f * s * t * t) + colors(first + 3) * (t * t * t)
    sum.map(v => Math.max(0f, v * Brightness))
