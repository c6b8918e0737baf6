package candela.build

import candela.bsdf.{InterfaceMaterial, Material, MaterialFactory}
import candela.color.Rgb

/** Recipes of materials. */
object Materials:
  private[build] val instead = "a grey diffuse surface is used"

  val all: Recipes[Material] = Recipes(
    "material",
    Vector(
      Matte, Plastic, Metal, Glass, Mirror, Uber, Substrate, Interface(""), Interface("none"),
      Interface("interface"), Diffuse, CoatedDiffuse, Conductor, Dielectric, ThinDielectric,
      DiffuseTransmission, Measured
    ),
    Vector(
      "mix", "fourier", "hair", "subsurface", "kdsubsurface", "translucent", "shinymetal",
      "coatedconductor", "disney"
    ).map(_ -> instead).toMap
  )

  /** Of shapes that no material was given for, or one that is not supported. */
  val default: Material =
    MaterialFactory.diffuse(candela.textures.ConstantRgb(Rgb.gray(0.5f)))

  def build(site: Site): Material = all.build(site).getOrElse(default)

final class Interface(name: String)
    extends MaterialRecipe(name, "no surface: light passes as if it were not there", sinceV3):
  protected def make()(using Site): Material = InterfaceMaterial
