package candela.bsdf.composite

import candela.bsdf.{Bsdf, BsdfFlags, Framed, FullReflectance, JoinedMaterial, Lobes, Material}
import candela.bsdf.microfacet.{MicrofacetReflection, TrowbridgeReitz}
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, Textured}

/** The clear coat of KHR_materials_clearcoat alone. */
final class GltfCoat(strength: FloatTexture, roughness: FloatTexture)
    extends Material,
      Textured(strength, roughness):
  def bsdf(at: ShadingPoint): Bsdf =
    GltfCoat.layer(GltfMaterial.unit(strength(at)), roughness(at))

object GltfCoat:
  private[composite] def layer(strength: Float, roughness: Float): Bsdf =
    val alpha = GltfMaterial.alphaOf(roughness)
    OfCoat(MicrofacetReflection(TrowbridgeReitz(alpha, alpha), FullReflectance), strength)

  /** @param normal of the coat */
  private[composite] def covering(base: Bsdf, layer: Bsdf, strength: Float, normal: Vec3): Bsdf =
    Lobes.Builder()
      .add(UnderCoat(base, strength, normal), 1f)
      .add(layer, 0.1f * strength)
      .result

/** A surface under a clear coat whose normals are others.
  *
  * @param base     in the frame of the surface
  * @param layer    a [[GltfCoat]], in the same frame
  * @param strength of the coat
  */
final class CoatedGltf(base: Material, layer: Material, strength: FloatTexture)
    extends JoinedMaterial(base, layer, strength):
  def bsdf(at: ShadingPoint): Bsdf =
    val (under, above) = (base.bsdf(at), layer.bsdf(at))
    val normal = above match
      case framed: Framed => framed.normal
      case _ => Vec3.Z
    val coat = GltfMaterial.unit(strength(at))
    if coat == 0f then under else GltfCoat.covering(under, above, coat, normal)

/** What is under a clear coat: by the angle of `wo` alone, as in KHR_materials_clearcoat. */
private final class UnderCoat(inner: Bsdf, coat: Float, normal: Vec3) extends Dimmed(inner):
  protected def passed(wo: Vec3, wi: Vec3): Float =
    val cosine = wo dot normal
    // Normals that face away are mirrored, as those of the coat
    val facing = if cosine * wo.z > 0f then cosine else 2f * normal.z * wo.z - cosine
    1f - coat * ClearcoatReflectance(facing).r
  override def flags: BsdfFlags = inner.flags | BsdfFlags.NonReciprocal
  override def regularized: Bsdf = UnderCoat(inner.regularized, coat, normal)

/** The reflection of that coat. */
private final class OfCoat(inner: Bsdf, coat: Float) extends Dimmed(inner):
  protected def passed(wo: Vec3, wi: Vec3): Float = coat * ClearcoatReflectance(wo.z).r
  override def flags: BsdfFlags = inner.flags | BsdfFlags.NonReciprocal
  override def regularized: Bsdf = OfCoat(inner.regularized, coat)
