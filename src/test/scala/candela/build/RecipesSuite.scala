package candela.build

import candela.bsdf.Material
import candela.build.cameras.{CameraPlan, Cameras}
import candela.build.film.{FilmSettings, Films, Filters}
import candela.build.integrators.{
  IntegratorPlan, Integrators, Renderers, VolumeIntegrators, VolumeMethod
}
import candela.build.lights.{AreaLightPlan, AreaLights, LightPlan, Lights, SkySampling}
import candela.build.materials.Materials
import candela.build.media.{Media, Volumes}
import candela.build.sampling.{SamplerPlan, SamplerRequest, Samplers}
import candela.build.options.{AcceleratorPlan, Accelerators, ColorSpaces, OptionStatements}
import candela.build.shapes.{ShapePlan, Shapes}
import candela.build.textures.Textures
import candela.color.ColorSpace
import candela.film.Filter
import candela.math.Transform
import candela.media.{Medium, Region}
import candela.scenefile.Directives
import candela.settings.RenderSettings
import candela.textures.{FloatTexture, RgbTexture}

final class FilmRecipesSuite extends RecipeLaws[FilmSettings](Films.all)

final class FilterRecipesSuite extends RecipeLaws[Filter](Filters.all)

final class SamplerRecipesSuite
    extends RecipeLaws[SamplerRequest => SamplerPlan](
      Samplers.all,
      use = make => make(SamplerRequest(None, 0))
    )

final class CameraRecipesSuite
    extends RecipeLaws[CameraPlan](
      Cameras.all,
      demanding = Set("realistic"),
      demandingIn = Set(candela.scenefile.Dialect.V3, candela.scenefile.Dialect.V4),
      use = _.create(Transform.Identity, candela.cameras.FilmFrame(8, 8))
    )

final class ShapeRecipesSuite
    extends RecipeLaws[Option[ShapePlan]](
      Shapes.all,
      demanding = Set(
        "trianglemesh", "plymesh", "loopsubdiv", "heightfield", "heightmap", "nurbs",
        "bilinearmesh", "curve"
      )
    )

final class MaterialRecipesSuite
    extends RecipeLaws[Material](
      Materials.all,
      demanding = Set("measured", "fourier", "mix", "twosided", "nested", "coating")
    )

final class LightRecipesSuite
    extends RecipeLaws[LightPlan](
      Lights.all,
      demanding = Set("goniometric", "projection"),
      demandingIn = Set(candela.scenefile.Dialect.V4),
      use = plan => plan.create(Transform.Identity, SkySampling.All)
    )

final class AreaLightRecipesSuite extends RecipeLaws[Option[AreaLightPlan]](AreaLights.all)

final class IntegratorRecipesSuite extends RecipeLaws[IntegratorPlan](Integrators.all)

final class FloatTextureRecipesSuite
    extends RecipeLaws[FloatTexture](Textures.floats, Set("imagemap", "grid"))

final class RgbTextureRecipesSuite
    extends RecipeLaws[RgbTexture](Textures.colors, Set("imagemap", "grid"))

final class MediumRecipesSuite
    extends RecipeLaws[Option[Medium]](
      Media.all,
      demanding = Set("heterogeneous", "uniformgrid", "rgbgrid", "nanovdb")
    )

final class VolumeRecipesSuite
    extends RecipeLaws[Option[Region]](Volumes.all, demanding = Set("volumegrid"))

final class RendererRecipesSuite extends RecipeLaws[Option[IntegratorPlan]](Renderers.all)

final class VolumeIntegratorRecipesSuite extends RecipeLaws[VolumeMethod](VolumeIntegrators.all)

final class OptionRecipesSuite extends RecipeLaws[RenderSettings](OptionStatements.all)

final class AcceleratorRecipesSuite
    extends RecipeLaws[AcceleratorPlan](Accelerators.all)

final class ColorSpaceRecipesSuite extends RecipeLaws[ColorSpace](ColorSpaces.all):

  test("the parser knows the same names"):
    assert(Directives.ColorSpaces.sorted == ColorSpace.all.map(_.name).sorted)
