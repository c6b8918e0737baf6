package candela.bsdf.composite

import candela.bsdf.{Bsdf, Lambert, Lobes, Material}
import candela.bsdf.microfacet.{PhongLobe, WardLobe, WardVariant}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Textured, Varying}

/** A diffuse and a glossy lobe without Fresnel terms. If their reflectances could add up to more
  * than 1, both are scaled to 0.99 everywhere, as in Mitsuba 0.6.
  *
  * @param conserves whether they are scaled
  */
abstract class GlossedDiffuse(
    diffuse: RgbTexture,
    specular: RgbTexture,
    conserves: Boolean,
    shape: Varying*
) extends Material,
      Textured((diffuse +: specular +: shape)*):

  // Images are read when they are seen
  private lazy val scale =
    val total = (diffuse.maximum + specular.maximum).max
    if conserves && total > 1f then 0.99f / total else 1f

  protected def gloss(specular: Rgb, at: ShadingPoint): Bsdf

  final def bsdf(at: ShadingPoint): Bsdf =
    val base = diffuse.positive(at) * scale
    val glossy = specular.positive(at) * scale
    Lobes.Builder().add(Lambert(base), base.max).add(gloss(glossy, at), glossy.max).result

/** The modified Phong model; `exponent` is at least 0. */
final class PhongMaterial(
    diffuse: RgbTexture,
    specular: RgbTexture,
    exponent: FloatTexture,
    conserves: Boolean
) extends GlossedDiffuse(diffuse, specular, conserves, exponent):
  protected def gloss(specular: Rgb, at: ShadingPoint): Bsdf =
    PhongLobe(specular, clamp(exponent(at), 0f, PhongMaterial.MaxExponent))

object PhongMaterial:
  /** That of a lobe narrower than the rounding of directions. */
  private val MaxExponent = 1e7f

/** Ward's model. */
final class WardMaterial(
    diffuse: RgbTexture,
    specular: RgbTexture,
    alphaU: FloatTexture,
    alphaV: FloatTexture,
    variant: WardVariant,
    conserves: Boolean
) extends GlossedDiffuse(diffuse, specular, conserves, alphaU, alphaV):
  override val isAnisotropic: Boolean = (alphaU.constant, alphaV.constant) match
    case (Some(u), Some(v)) => u != v
    case _ => !(alphaU eq alphaV)

  protected def gloss(specular: Rgb, at: ShadingPoint): Bsdf =
    WardLobe(specular, alphaU(at), alphaV(at), variant)
