package candela.build.materials

import candela.bsdf.{Material, MaterialFactory}
import candela.build.recipe.*
import candela.color.Rgb

/** Recipes of materials. */
object Materials:
  val all: Recipes[Material] = Recipes(
    "material",
    Vector(
      Matte,
      Translucent,
      Diffuse,
      DiffuseTransmission,
      Plastic,
      Substrate,
      Uber,
      Disney,
      CoatedDiffuse,
      CoatedConductor,
      Glass,
      Dielectric,
      ThinDielectric,
      Mirror,
      Metal,
      ShinyMetal,
      Conductor,
      Subsurface,
      KdSubsurface,
      Hair,
      MeasuredTable,
      MeasuredBsdf,
      Fourier,
      Mix,
      Interface("", sinceV3),
      Interface("none", sinceV3),
      Interface("interface", onlyV4)
    )
  )

  /** Of shapes that no material was given for, or one that is not supported. */
  val default: Material =
    MaterialFactory.diffuse(candela.textures.ConstantRgb(Rgb.gray(0.5f)))

  def build(site: Site): Material =
    all.build(site).getOrElse(StandIns.material(site.resources.basis))
