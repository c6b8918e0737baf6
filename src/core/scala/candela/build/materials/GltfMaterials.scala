package candela.build.materials

import candela.bsdf.Material
import candela.bsdf.composite.{GltfMaterial, GltfParameters}
import candela.build.recipe.*
import candela.color.Rgb

/** The material of glTF 2.0 and its extensions. */
object GltfRecipe extends MaterialRecipe("gltf", "metallic-roughness material of glTF", onlyGltf):
  private val color = rgbTexture("color", "base colour")(Rgb.White)
  private val metallic = floatTexture("metallic", "0: dielectric, 1: metal")(1f)
  private val roughness =
    floatTexture("roughness", "roughness; the slopes' width is its square")(1f)
  private val eta = float("eta", "index of refraction", range = Range.atLeast(0f).deferred)(1.5f)
  private val specular = floatTexture("specular", "strength of the dielectric's reflection")(1f)
  private val specularColor = rgbTexture(
    "specularcolor",
    "tint of the dielectric's reflection",
    role = SpectrumRole.Unbounded
  )(Rgb.White)
  private val transmission =
    floatTexture("transmission", "transmitted fraction of what is not reflected")(0f)
  private val thin = bool("thin", "transmit without refraction, as a thin wall")(true)
  private val coat = floatTexture("clearcoat", "strength of the clear coat")(0f)
  private val coatRoughness = floatTexture("clearcoatroughness", "roughness of the clear coat")(0f)
  private val sheen = rgbTexture("sheencolor", "colour of the sheen")(Rgb.Black)
  private val sheenRoughness = floatTexture("sheenroughness", "roughness of the sheen")(0f)
  private val anisotropy = floatTexture("anisotropy", "stretch of the highlights")(0f)
  private val rotation =
    float("anisotropyrotation", "angle of that stretch from the tangent", unit = "radians")(0f)

  protected def create()(using Site): Material =
    GltfMaterial(GltfParameters(
      color(),
      metallic(),
      roughness(),
      eta(),
      specular(),
      specularColor(),
      transmission(),
      thin(),
      coat(),
      coatRoughness(),
      sheen(),
      sheenRoughness(),
      anisotropy(),
      rotation()
    ))
