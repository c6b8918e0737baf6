package candela.build.materials

import candela.bsdf.Material
import candela.bsdf.composite.{HairMaterial, Pigment}
import candela.build.recipe.*
import candela.color.Rgb

object HairRecipe
    extends MaterialRecipe("hair", "curves that scatter as hair does", sinceV3, bumps = false):
  private val sigmaA = rgbTexture(
    "sigma_a",
    "absorption coefficient inside",
    unit = "1/width",
    shown = "of eumelanin 1.3"
  )(Rgb.Black)
  private val color =
    rgbTexture("color", "instead of `sigma_a`: of the hair", shown = "none")(Rgb.Black)
  private val reflectance =
    rgbTexture("reflectance", "another name of `color`", onlyV4, shown = "none")(Rgb.Black)
  private val eumelanin =
    floatTexture("eumelanin", "instead of `sigma_a`: black and brown pigment", shown = "none")(0f)
  private val pheomelanin =
    floatTexture("pheomelanin", "instead of `sigma_a`: red pigment", shown = "none")(0f)
  private val eta = floatTexture("eta", "index of refraction")(1.55f)
  private val betaM = floatTexture("beta_m", "roughness along the hair, 0 to 1")(0.3f)
  private val betaN = floatTexture("beta_n", "roughness around the hair, 0 to 1")(0.3f)
  private val alpha = floatTexture("alpha", "tilt of the scales", unit = "degrees")(2f)

  protected def make()(using site: Site): Material =
    HairMaterial(pigment(), eta(), betaM(), betaN(), alpha())

  private def pigment()(using site: Site): Pigment =
    val byColor = reflectance.given_().orElse(color.given_())
    val hasMelanin = Seq("eumelanin", "pheomelanin").exists(site.declaration.param(_).nonEmpty)
    val kinds = Seq(sigmaA.given_().nonEmpty, byColor.nonEmpty, hasMelanin).count(identity)
    if kinds > 1 then
      site.warn("`sigma_a`, a colour and pigments are alternatives: the first of these is used")
    (sigmaA.given_(), byColor) match
      case (Some(s), _) => Pigment.Absorption(s)
      case (_, Some(c)) => Pigment.Color(c)
      case _ if hasMelanin => Pigment.Melanin(eumelanin(), pheomelanin(), site.resources.basis)
      case _ =>
        Pigment.Melanin(
          candela.textures.ConstantFloat(1.3f),
          pheomelanin(),
          site.resources.basis
        )
