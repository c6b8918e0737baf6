package candela.build

import candela.build.cameras.Cameras
import candela.build.film.{Films, Filters}
import candela.build.integrators.{Integrators, Renderers, VolumeIntegrators}
import candela.build.lights.{AreaLights, Lights}
import candela.build.materials.Materials
import candela.build.media.{Media, Volumes}
import candela.build.recipe.*
import candela.build.sampling.Samplers
import candela.build.settings.{Accelerators, ColorSpaces, OptionStatements}
import candela.build.shapes.Shapes
import candela.build.textures.Textures

/** A kind of statement, and all types that it can name.
  *
  * @param name    as the statement is called, with what tells it from others of the same name
  * @param aliases further names by which people may ask for it
  */
final case class Category(
    name: String,
    meaning: String,
    recipes: Recipes[?],
    aliases: Vector[String] = Vector.empty
)

/** All that scene files can declare, in the order of the reference. */
object Language:
  val categories: Vector[Category] = Vector(
    Category("Shape", "surfaces", Shapes.all),
    Category("Material", "how surfaces scatter light", Materials.all, Vector("MakeNamedMaterial")),
    Category(
      "Texture (float)",
      "numbers over a surface",
      Textures.floats,
      Vector("Texture", "FloatTexture")
    ),
    Category(
      "Texture (spectrum)",
      "colours over a surface",
      Textures.colors,
      Vector("Texture", "SpectrumTexture")
    ),
    Category("LightSource", "lights that are no surfaces", Lights.all, Vector("Light")),
    Category("AreaLightSource", "surfaces that emit light", AreaLights.all, Vector("AreaLight")),
    Category("Camera", "where the picture is taken from", Cameras.all),
    Category("Film", "what the picture is recorded on", Films.all),
    Category("PixelFilter", "how samples become pixels", Filters.all, Vector("Filter")),
    Category("Sampler", "where samples are taken", Samplers.all),
    Category(
      "Integrator",
      "how light is followed; v2 says SurfaceIntegrator",
      Integrators.all,
      Vector("SurfaceIntegrator")
    ),
    Category("VolumeIntegrator", "how light is followed in v2's volumes", VolumeIntegrators.all),
    Category("Renderer", "what v2 does with the scene", Renderers.all),
    Category("Accelerator", "how rays find surfaces", Accelerators.all),
    Category("MakeNamedMedium", "fog, smoke and the like, v3 and v4", Media.all, Vector("Medium")),
    Category("Volume", "fog, smoke and the like, v2", Volumes.all),
    Category("ColorSpace", "what v4's colours mean", ColorSpaces.all),
    Category("Option", "settings of the whole scene, v4", OptionStatements.all)
  )
