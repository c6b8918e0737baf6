package candela.build.materials

import candela.bsdf.{Material, RoughDiffuseMaterial}
import candela.bsdf.composite.{PhongMaterial, WardMaterial}
import candela.bsdf.layered.{CoatingMaterial, ScatteringLayerMaterial}
import candela.bsdf.microfacet.WardVariant
import candela.build.media.Scatters
import candela.build.recipe.*
import candela.color.Rgb
import candela.diagnostics.Code
import candela.textures.RgbTexture

/** Recipes of materials that Mitsuba had until version 0.6. */
private trait GlossedFields extends Fields:
  protected val diffuse: Field[RgbTexture] =
    rgbTexture("reflectance", "diffuse reflectance")(Rgb.gray(0.5f))
  protected val specular: Field[RgbTexture] =
    rgbTexture("specular", "glossy reflectance")(Rgb.gray(0.2f))
  protected val conserves: Field[Boolean] =
    bool("conserveenergy", "scale both reflectances if they may add up to more than 1")(true)

object PhongRecipe
    extends MaterialRecipe("phong", "modified Phong model", onlyMitsuba)
    with GlossedFields:
  private val exponent =
    floatTexture("exponent", "exponent of the glossy lobe", range = Range.nonNegative)(30f)
  protected def create()(using Site): Material =
    PhongMaterial(diffuse(), specular(), exponent(), conserves())

object WardRecipe
    extends MaterialRecipe("ward", "Ward's anisotropic model", onlyMitsuba)
    with GlossedFields:
  private val u = floatTexture("uroughness", "roughness along u", range = Range.nonNegative)(0.1f)
  private val v = floatTexture("vroughness", "roughness along v", range = Range.nonNegative)(0.1f)
  private val variant =
    oneOf("variant", "normalisation", Seq("ward", "ward-duer", "balanced"))("balanced")
  protected def create()(using Site): Material =
    val kind = variant() match
      case "ward" => WardVariant.Original
      case "ward-duer" => WardVariant.Duer
      case _ => WardVariant.Balanced
    WardMaterial(diffuse(), specular(), u(), v(), kind, conserves())

object RoughDiffuseRecipe
    extends MaterialRecipe("roughdiffuse", "the model of Oren and Nayar in full", onlyMitsuba):
  private val reflectance =
    rgbTexture("reflectance", "diffuse reflectance, 0 to 1")(Rgb.gray(0.5f))
  private val alpha =
    floatTexture(
      "roughness",
      "root mean square slope of the facets",
      range = Range.nonNegative
    )(0.2f)
  private val isFast = bool("fast", "use the approximation without interreflection")(false)
  protected def create()(using Site): Material =
    RoughDiffuseMaterial(reflectance(), alpha(), isFast())

object CoatingRecipe
    extends RoughRecipe("coating", "dielectric coat on a named material", onlyMitsuba, 0f):
  private val baseName = string("material", "name of the material")("")
  private val eta = float("eta", "index of refraction of the coat")(1.5046f)
  private val specular = rgbTexture("specular", "scale of the coat's reflection")(Rgb.White)
  private val thickness = float("thickness", "thickness of the coat")(1f)
  private val sigmaA = rgbTexture(
    "sigma_a",
    "absorption coefficient of the coat",
    unit = "1/thickness",
    role = SpectrumRole.Unbounded
  )(Rgb.Black)
  protected def create()(using site: Site): Material =
    val rough = roughness()
    if !rough.isConstant then
      site.warn(
        Code.Unsupported,
        "what passes the coat of \"coating\" is that of its roughness at (0, 0)"
      )
    CoatingMaterial(
      named(baseName(), "material"),
      rough,
      eta(),
      sigmaA(),
      thickness(),
      specular(),
      site.resources.coats
    )

object ScatteringLayerRecipe
    extends MaterialRecipe("scatteringlayer", "flat layer that scatters light once", onlyMitsuba)
    with Scatters:
  private val sigmaA = coefficient("sigma_a", "absorption coefficient")
  private val sigmaS = coefficient("sigma_s", "scattering coefficient")
  private val thickness = float("thickness", "thickness of the layer")(1f)
  private def coefficient(name: String, meaning: String) =
    rgbTexture(name, meaning, unit = "1/thickness", role = SpectrumRole.Unbounded)(Rgb.White)
  protected def create()(using Site): Material =
    ScatteringLayerMaterial(sigmaA(), sigmaS(), thickness(), phase())
