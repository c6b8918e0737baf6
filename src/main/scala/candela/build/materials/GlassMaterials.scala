package candela.build.materials

import candela.bsdf.{
  ConstantMaterial, DielectricMaterial, DispersiveMaterial, Material, Roughness, RoughnessModel,
  ThinDielectric
}
import candela.build.recipe.*
import candela.color.Rgb
import candela.scenefile.Dialect

object GlassRecipe
    extends MaterialRecipe("glass", "reflects and refracts, smooth or rough", untilV3):
  private val kr = rgbTexture("Kr", "factor of reflection")(Rgb.White)
  private val kt = rgbTexture("Kt", "factor of refraction")(Rgb.White)
  private val eta = floatTexture("eta", "index of refraction", onlyV3, shown = "index")(1.5f)
  private val index = floatTexture("index", "index of refraction")(1.5f)
  private val u = floatTexture("uroughness", "along u; 0: smooth", onlyV3)(0f)
  private val v = floatTexture("vroughness", "along v; 0: smooth", onlyV3)(0f)
  private val remap = bool("remaproughness", "is roughness 0 to 1, or alpha?", onlyV3)(true)
  protected def make()(using site: Site): Material =
    if site.dialect == Dialect.V2 then DielectricMaterial.old(kr(), kt(), index())
    else
      val model = if remap() then RoughnessModel.PolynomialAlpha else RoughnessModel.BoundedAlpha
      val rough = Roughness(u(), v(), model, smoothAtZero = true)
      new DielectricMaterial(kr(), kt(), eta.given_().getOrElse(index()), rough)

object DielectricRecipe
    extends RoughRecipe("dielectric", "glass and the like, smooth or rough", onlyV4, 0f):
  private val eta = spectrum("eta", "index of refraction")(Indices.glass)
  protected def make()(using Site): Material =
    Indices.dispersive(eta()) match
      case Some((byWavelength, usual)) => DispersiveMaterial(byWavelength, usual, roughness())
      case None => DielectricMaterial(Indices.one(eta()), roughness())

object ThinDielectricRecipe
    extends MaterialRecipe("thindielectric", "a thin pane of glass", onlyV4):
  private val eta = spectrum("eta", "index of refraction")(Indices.glass)
  protected def make()(using Site): Material = ConstantMaterial(ThinDielectric(Indices.one(eta())))
