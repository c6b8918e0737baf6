package candela.bsdf.composite

import candela.bsdf.{Bsdf, BsdfLaws, Material}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{ConstantFloat, ConstantRgb}

/** Tests of a material with Burley's parameters. */
abstract class BurleySuite(make: DisneyParameters => Material) extends BsdfLaws:
  protected final val color: Rgb = Rgb(0.6f, 0.4f, 0.2f)

  protected final def material(
      color: Rgb = color,
      metallic: Float = 0f,
      index: Float = 1.5f,
      roughness: Float = 0.6f,
      specularTint: Float = 0f,
      anisotropic: Float = 0f,
      sheen: Float = 0f,
      sheenTint: Float = 0.5f,
      clearcoat: Float = 0f,
      clearcoatGloss: Float = 0f,
      transmission: Float = 0f,
      isThin: Boolean = false,
      flatness: Float = 0f,
      diffTrans: Float = 1f
  ): Bsdf =
    def constant(x: Float) = ConstantFloat(x)
    make(
      DisneyParameters(
        ConstantRgb(color),
        constant(metallic),
        constant(index),
        constant(roughness),
        constant(specularTint),
        constant(anisotropic),
        constant(sheen),
        constant(sheenTint),
        constant(clearcoat),
        constant(clearcoatGloss),
        constant(transmission),
        isThin,
        constant(flatness),
        constant(diffTrans)
      )
    ).bsdf(ShadingPoint())
