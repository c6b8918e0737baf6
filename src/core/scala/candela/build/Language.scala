package candela.build

import candela.build.cameras.Cameras
import candela.build.film.{Films, Filters}
import candela.build.integrators.{Integrators, Renderers, VolumeIntegrators}
import candela.build.lights.{AreaLights, Lights}
import candela.build.materials.Materials
import candela.build.media.{Media, Volumes}
import candela.build.recipe.*
import candela.build.sampling.Samplers
import candela.build.options.{Accelerators, ColorSpaces, OptionStatements}
import candela.build.shapes.Shapes
import candela.build.textures.Textures

/** A category of statements with all its types.
  *
  * @param name    name of the statement, made unique if categories share it
  * @param aliases alternative names on the command line
  */
final case class Category(
    name: String,
    meaning: String,
    recipes: Recipes[?],
    aliases: Vector[String] = Vector.empty
)

/** All categories of scene files, in the order of the reference. */
object Language:
  val categories: Vector[Category] = Vector(
    Category("Shape", "surfaces", Shapes.all),
    Category(
      "Material",
      "BSDFs and BSSRDFs of surfaces",
      Materials.all,
      Vector("MakeNamedMaterial")
    ),
    Category(
      "Texture (float)",
      "float textures",
      Textures.floats,
      Vector("Texture", "FloatTexture")
    ),
    Category(
      "Texture (spectrum)",
      "spectrum textures",
      Textures.colors,
      Vector("Texture", "SpectrumTexture")
    ),
    Category("LightSource", "lights, except area lights", Lights.all, Vector("Light")),
    Category("AreaLightSource", "area lights", AreaLights.all, Vector("AreaLight")),
    Category("Camera", "cameras", Cameras.all),
    Category("Film", "films", Films.all),
    Category("PixelFilter", "reconstruction filters", Filters.all, Vector("Filter")),
    Category("Sampler", "sample generators", Samplers.all),
    Category(
      "Integrator",
      "light transport algorithms; SurfaceIntegrator in v2",
      Integrators.all,
      Vector("SurfaceIntegrator")
    ),
    Category("VolumeIntegrator", "rendering of v2's volumes", VolumeIntegrators.all),
    Category("Renderer", "v2's renderers", Renderers.all),
    Category("Accelerator", "ray intersection acceleration structures", Accelerators.all),
    Category("MakeNamedMedium", "participating media, v3 and v4", Media.all, Vector("Medium")),
    Category("Volume", "participating media, v2", Volumes.all),
    Category("ColorSpace", "RGB colour spaces, v4", ColorSpaces.all),
    Category("Option", "settings of the whole scene, v4", OptionStatements.all)
  )
