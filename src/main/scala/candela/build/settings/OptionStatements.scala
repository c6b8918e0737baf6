package candela.build.settings

import candela.build.recipe.*
import candela.color.ColorSpace

/** Settings of all of v4's `Option` statements. */
final case class SceneSettings(seed: Int)

/** v4's options, as parameters in lower case, which is how the reader passes them. */
object OptionRecipe extends Recipe[SceneSettings]("", "settings of the whole scene", onlyV4):
  private val seed = integer("seed", "random seed, if the sampler sets none")(0)
  notYet("samples cover the whole pixel")(
    bool("disablepixeljitter", "place all samples at the pixel centre")(false)
  )
  notYet("textures keep their filters")(
    bool("disabletexturefiltering", "point-sample textures")(false)
  )
  notYet("materials are unchanged")(
    bool("forcediffuse", "make all materials diffuse")(false)
  )
  notYet("meshes are not displaced")(
    float("displacementedgescale", "scale of `edgelength` of all meshes")(1f)
  )
  notYet("comparing images is up to `candela compare`")(
    string("msereferenceimage", "reference image", shown = "none")(""),
    string("msereferenceout", "file for the errors", shown = "none")("")
  )
  noMeaning("rendering is RGB: no wavelengths are sampled")(
    bool("disablewavelengthjitter", "use the same wavelengths for all samples")(false)
  )
  noMeaning("only affects rounding")(
    string("rendercoordsys", "space of ray tracing: camera, cameraworld, world")("cameraworld")
  )
  noMeaning("no statistics images are written")(bool(
    "pixelstats",
    "write statistics images"
  )(false))
  noMeaning("there is only one renderer")(bool("wavefront", "use the wavefront renderer")(false))

  protected def make()(using Site): SceneSettings = SceneSettings(seed())

object OptionStatements:
  val all: Recipes[SceneSettings] = Recipes("option", Vector(OptionRecipe))

/** Colour spaces of v4's `ColorSpace`. */
object ColorSpaces:
  val all: Recipes[ColorSpace] = Recipes(
    "color space",
    ColorSpace.all.map(ColorSpaceRecipe(_))
  )

final class ColorSpaceRecipe(space: ColorSpace)
    extends Recipe[ColorSpace](space.name, space.meaning, onlyV4):
  protected def make()(using Site): ColorSpace = space
