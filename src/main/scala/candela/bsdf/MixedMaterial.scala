package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{RgbTexture, Textured}

/** Two materials in one: `amount` (held to [0, 1], by colour) of the first, the rest of the second.
  *
  * The normal that bumps give the first holds for both, as in PBRT 2 and 3.
  */
final class MixedMaterial(first: Material, second: Material, amount: RgbTexture)
    extends Material,
      Textured(first, second, amount):
  def bsdf(at: ShadingPoint): Bsdf =
    val part = amount.albedo(at)
    val rest = Rgb.White - part
    val frame = at.frame.toFrame
    val other = MixedMaterial.scatter(second, at)
    at.frame.set(frame)
    Lobes.Builder()
      .addScaled(MixedMaterial.scatter(first, at), part)
      .addScaled(other, rest)
      .result

  override def isDispersive: Boolean = first.isDispersive || second.isDispersive

object MixedMaterial:
  private val clear = Passthrough(Rgb.White)

  /** In a mixture, no surface is one that lets all light go straight on. */
  private def scatter(material: Material, at: ShadingPoint): Bsdf =
    if material eq InterfaceMaterial then clear else material.bsdf(at)
