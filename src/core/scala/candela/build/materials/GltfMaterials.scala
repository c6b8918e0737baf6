package candela.build.materials

import candela.bsdf.{FramedMaterial, Material}
import candela.bsdf.composite.{
  CoatedGltf, FilmColors, GltfAnisotropy, GltfCoat, GltfIridescence, GltfMaterial, GltfParameters
}
import candela.build.recipe.*
import candela.color.{Cauchy, Rgb}
import candela.textures.ConstantFloat

/** The material of glTF 2.0 and its extensions. */
object GltfRecipe extends MaterialRecipe("gltf", "metallic-roughness material of glTF", onlyGltf):
  private val color = rgbTexture("color", "base colour")(Rgb.White)
  private val metallic = floatTexture("metallic", "0: dielectric, 1: metal")(1f)
  private val roughness =
    floatTexture(
      "roughness",
      "roughness; the slopes' width is its square",
      range = Range.nonNegative
    )(1f)
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
  private val coatRoughness =
    floatTexture("clearcoatroughness", "roughness of the clear coat", range = Range.nonNegative)(0f)
  private val coatNormals =
    NormalMapFields("clearcoat", "clear coat's normal map", onlyGltf)
  private val sheen = rgbTexture("sheencolor", "colour of the sheen")(Rgb.Black)
  private val sheenRoughness =
    floatTexture("sheenroughness", "roughness of the sheen", range = Range.nonNegative)(0f)
  private val anisotropy = floatTexture("anisotropy", "stretch of the highlights")(0f)
  private val anisotropyRotation =
    float("anisotropyrotation", "angle of that stretch from the tangent", unit = "radians")(0f)
  private val anisotropyX =
    floatTexture("anisotropyx", "direction of the stretch along the tangent, from 0 for -1")(1f)
  private val anisotropyY =
    floatTexture("anisotropyy", "likewise along the bitangent")(0.5f)
  private val iridescence =
    floatTexture("iridescence", "strength of a thin film on the surface")(0f)
  private val iridescenceEta =
    float("iridescenceeta", "index of the film", range = Range.atLeast(1f).limited)(1.3f)
  private val minThickness = float(
    "iridescencemin",
    "thickness of the film where its texture is 0",
    unit = "nm",
    range = Range.atLeast(0f).limited
  )(100f)
  private val maxThickness = float(
    "iridescencemax",
    "thickness of the film where its texture is 1",
    unit = "nm",
    range = Range.atLeast(0f).limited
  )(400f)
  private val thickness =
    floatTexture("iridescencethickness", "thickness of the film between both")(1f)
  private val dispersion =
    float("dispersion", "20 over the Abbe number", range = Range.atLeast(0f).limited)(0f)
  private val diffuseTransmission = floatTexture(
    "diffusetransmission",
    "fraction of diffuse light that is transmitted instead of reflected"
  )(0f)
  private val diffuseTransmissionColor =
    rgbTexture("diffusetransmissioncolor", "colour of what is transmitted diffusely")(Rgb.White)

  /** Whether the clear coat has other normals than what is beneath it. */
  private def isCoatApart(using site: Site): Boolean =
    site.declaration.param(coat.name).isDefined &&
      (coatNormals.given_().isDefined || site.declaration.param("normalmap").isDefined)

  override protected def covered(surface: Material)(using Site): Material =
    if !isCoatApart then surface
    else
      val layer = GltfCoat(coat(), coatRoughness())
      val above = relieved(layer, Some(coatNormals)).fold(layer)(FramedMaterial(_))
      CoatedGltf(FramedMaterial(surface), above, coat())

  protected def create()(using site: Site): Material =
    val index = SpectralValue.Wavelengths(Cauchy(eta(), dispersion()))
    val atHero = if dispersion() > 0f then Indices.scalar(index) else eta()
    val colors = FilmColors.of(site.resources.basis)
    Indices.disperse(index)(GltfMaterial(GltfParameters(
      color(),
      metallic(),
      roughness(),
      atHero,
      specular(),
      specularColor(),
      transmission(),
      thin(),
      if isCoatApart then ConstantFloat(0f) else coat(),
      coatRoughness(),
      sheen(),
      sheenRoughness(),
      GltfAnisotropy(anisotropy(), anisotropyX(), anisotropyY(), anisotropyRotation()),
      GltfIridescence(
        iridescence(), iridescenceEta(), minThickness(), maxThickness(), thickness(), colors
      ),
      diffuseTransmission(),
      diffuseTransmissionColor()
    )))
