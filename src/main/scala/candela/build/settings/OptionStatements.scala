package candela.build.settings

import candela.build.recipe.*

/** What v4's `Option` statements say, all together. */
final case class SceneSettings(seed: Int)

/** v4's options: each is a parameter here. The reader knows their names in lower case. */
object OptionRecipe extends Recipe[SceneSettings]("", "settings of the whole scene", onlyV4):
  private val seed = integer("seed", "of the random numbers, where the sampler says none")(0)
  notYet("samples lie anywhere in the pixel")(
    bool("disablepixeljitter", "sample the middle of each pixel")(false)
  )
  notYet("textures are read as they say")(
    bool("disabletexturefiltering", "read textures at one point")(false)
  )
  notYet("materials stay as they are")(
    bool("forcediffuse", "make all materials diffuse")(false)
  )
  notYet("meshes are not displaced")(
    float("displacementedgescale", "factor of `edgelength` of all meshes")(1f)
  )
  notYet("nothing is compared; `candela compare` does that")(
    string("msereferenceimage", "image to compare with", shown = "none")(""),
    string("msereferenceout", "where to write how they differ", shown = "none")("")
  )
  noMeaning("no wavelengths are sampled")(
    bool("disablewavelengthjitter", "the same wavelengths for all samples")(false)
  )
  noMeaning("it changes how numbers are rounded, and little else")(
    string("rendercoordsys", "space in which rays live: camera, cameraworld, world")("cameraworld")
  )
  noMeaning("no statistics are written")(bool("pixelstats", "write images of statistics")(false))
  noMeaning("there is one way to render")(bool("wavefront", "use the wavefront renderer")(false))

  protected def make()(using Site): SceneSettings = SceneSettings(seed())

object OptionStatements:
  val all: Recipes[SceneSettings] = Recipes("option", Vector(OptionRecipe))

/** The names that v4's `ColorSpace` knows. */
object ColorSpaces:
  val all: Recipes[Unit] = Recipes(
    "color space",
    Vector(
      ColorSpaceRecipe("srgb", "sRGB: primaries of ITU-R BT.709, white D65"),
      WideSpaceRecipe("dci-p3", "primaries of DCI P3, white D65"),
      WideSpaceRecipe("rec2020", "primaries of ITU-R BT.2020, white D65"),
      WideSpaceRecipe("aces2065-1", "primaries AP0 of SMPTE ST 2065-1, white near D60")
    )
  )

class ColorSpaceRecipe(name: String, meaning: String) extends Recipe[Unit](name, meaning, onlyV4):
  protected def make()(using Site): Unit = ()

final class WideSpaceRecipe(name: String, meaning: String) extends ColorSpaceRecipe(name, meaning):
  override def pending: Option[String] = Some("colours are taken as sRGB")
