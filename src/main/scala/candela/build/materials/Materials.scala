package candela.build.materials

import candela.bsdf.{DiffuseMaterial, Material}
import candela.build.recipe.*
import candela.color.Rgb

/** Recipes of materials. */
object Materials:
  val all: Recipes[Material] = Recipes(
    "material",
    Vector(
      MatteRecipe,
      TranslucentRecipe,
      DiffuseRecipe,
      DiffuseTransmissionRecipe,
      PlasticRecipe,
      SubstrateRecipe,
      UberRecipe,
      DisneyRecipe,
      CoatedDiffuseRecipe,
      CoatedConductorRecipe,
      GlassRecipe,
      DielectricRecipe,
      ThinDielectricRecipe,
      MirrorRecipe,
      MetalRecipe,
      ShinyMetalRecipe,
      ConductorRecipe,
      SubsurfaceRecipe,
      KdSubsurfaceRecipe,
      HairRecipe,
      MeasuredTableRecipe,
      MeasuredBsdfRecipe,
      FourierRecipe,
      MixRecipe,
      InterfaceRecipe("", sinceV3),
      InterfaceRecipe("none", sinceV3),
      InterfaceRecipe("interface", onlyV4)
    )
  )

  /** Of shapes that no material was given for, or one that is not supported. */
  val default: Material =
    DiffuseMaterial(candela.textures.ConstantRgb(Rgb.gray(0.5f))).folded

  def build(site: Site): Material =
    all.build(site).getOrElse(StandIns.material(site.resources.basis))
