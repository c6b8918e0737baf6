package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** The broad part of Disney's material: all that goes by the cosines alone.
  *
  * @param diffuse   colour and weight of reflection that a coat's Fresnel terms dim at grazing
  *                  angles
  * @param flat      of an approximation of scattering below the surface, which looks flat
  * @param retro     of light that rough surfaces send back to where it came from
  * @param sheen     of the sheen of cloth
  * @param roughness of the surface, in [0, 1]
  *
  * Sources: Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 course; Burley, "Extending
  * the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH 2015 course, eq. 4.
  */
final class DisneyDiffuse(diffuse: Rgb, flat: Rgb, retro: Rgb, sheen: Rgb, roughness: Float)
    extends CosineSampled:
  private val isFlat = !flat.isBlack

  protected def value(wo: Vec3, wi: Vec3): Rgb =
    val across = wo + wi
    if across.isZero then Rgb.Black
    else
      val cosO = Hemisphere.absCos(wo)
      val cosI = Hemisphere.absCos(wi)
      val cosD = wi dot across.normalized
      val o = Schlick.weight(cosO)
      val i = Schlick.weight(cosI)
      val back = 2f * roughness * cosD * cosD
      val base = diffuse * (InvPi * (1f - 0.5f * o) * (1f - 0.5f * i)) +
        retro * (InvPi * back * (o + i + o * i * (back - 1f))) +
        sheen * Schlick.weight(cosD)
      if isFlat then base + flat * (InvPi * flattened(cosO, cosI, o, i, 0.5f * back)) else base

  /** After Hanrahan and Krueger. Its factor 1.25 keeps the albedo roughly. */
  private def flattened(cosO: Float, cosI: Float, o: Float, i: Float, grazing: Float): Float =
    val both = lerp(o, 1f, grazing) * lerp(i, 1f, grazing)
    1.25f * (both * (1f / (cosO + cosI) - 0.5f) + 0.5f)

/** The approximation of Fresnel's equations of Schlick, "An Inexpensive BRDF Model for
  * Physically-based Rendering", Eurographics 1994.
  */
private[bsdf] object Schlick:

  /** (1 − cos θ)⁵: how far from the reflectance at normal incidence to 1. */
  def weight(cosine: Float): Float =
    val m = clamp(1f - cosine, 0f, 1f)
    square(m * m) * m

  /** What an interface of this index reflects at normal incidence. */
  def normal(eta: Float): Float = square((eta - 1f) / (eta + 1f))
