package candela.build.materials

import candela.diagnostics.Code
import candela.bsdf.Material
import candela.bsdf.composite.{HairMaterial, HairOffset, Pigment}
import candela.build.recipe.*
import candela.color.Rgb

object HairRecipe
    extends MaterialRecipe("hair", "hair fibres, for curves", sinceV3, bumps = false):
  private val sigmaA = rgbTexture(
    "sigma_a",
    "absorption coefficient of the fibre",
    unit = "1/width",
    shown = "of eumelanin 1.3",
    role = SpectrumRole.Unbounded
  )(Rgb.Black)
  private val color =
    rgbTexture("color", "hair colour, instead of `sigma_a`", shown = "none")(Rgb.Black)
  private val reflectance =
    rgbTexture("reflectance", "alias of `color`", onlyV4, shown = "none")(Rgb.Black)
  private val eumelanin =
    floatTexture(
      "eumelanin",
      "concentration of eumelanin (black and brown), instead of `sigma_a`",
      shown = "none"
    )(0f)
  private val pheomelanin =
    floatTexture(
      "pheomelanin",
      "concentration of pheomelanin (red), instead of `sigma_a`",
      shown = "none"
    )(0f)
  private val eta = floatTexture("eta", "index of refraction", range = Indices.range)(1.55f)
  private val betaM =
    floatTexture("beta_m", "longitudinal roughness", range = Range(0f, 1f).limited)(0.3f)
  private val betaN =
    floatTexture("beta_n", "azimuthal roughness", range = Range(0f, 1f).limited)(0.3f)
  private val alpha = floatTexture("alpha", "tilt of the cuticle scales", unit = "degrees")(2f)

  private val ribbon =
    bool("ribbon", "for pbrt's curves", onlyMitsuba)(false)

  protected def create()(using site: Site): Material =
    val offset =
      if !site.speaks(onlyMitsuba) then HairOffset.Across
      else if ribbon() then HairOffset.Mirrored
      else HairOffset.Round
    HairMaterial(offset, pigment(), eta(), betaM(), betaN(), alpha())

  private def pigment()(using site: Site): Pigment =
    val byColor = reflectance.given_().orElse(color.given_())
    val hasMelanin = Seq("eumelanin", "pheomelanin").exists(site.declaration.param(_).nonEmpty)
    val kinds = Seq(sigmaA.given_().nonEmpty, byColor.nonEmpty, hasMelanin).count(identity)
    if kinds > 1 then
      site.warn(
        Code.ExclusiveParameters,
        "`sigma_a`, a colour and pigments are alternatives; using the first of these"
      )
    (sigmaA.given_(), byColor) match
      case (Some(s), _) => Pigment.Absorption(s)
      case (_, Some(c)) => Pigment.Color(c)
      case _ if hasMelanin =>
        Pigment.Melanin(eumelanin(), pheomelanin(), site.resources.basis.lookUp)
      case _ =>
        Pigment.Melanin(
          candela.textures.ConstantFloat(1.3f),
          pheomelanin(),
          site.resources.basis.lookUp
        )
