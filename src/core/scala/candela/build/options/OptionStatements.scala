package candela.build.options

import candela.diagnostics.{Code, SourcePos}
import candela.io.SceneFolder
import candela.build.recipe.*
import candela.color.ColorSpace
import candela.settings.{OutputSettings, RenderSettings}

/** v4's options, as parameters in lower case, which is how the reader passes them. */
object OptionRecipe extends Recipe[RenderSettings]("", "settings of the whole scene", onlyV4):
  private val seed = integer("seed", "random seed, if the sampler sets none")(0)
  private val centers = bool(
    "disablepixeljitter",
    "place all samples at the pixel centre, and in the middle of lens and shutter; no effect on " +
      "the chains of \"mlt\""
  )(false)
  private val unfiltered = bool("disabletexturefiltering", "point-sample textures")(false)
  private val diffuse = bool("forcediffuse", "make all materials diffuse")(false)
  private val oneColorSet = bool(
    "disablewavelengthjitter",
    "use the same wavelengths for all samples, if rendering is spectral: colours are off"
  )(false)
  private val edgeScale = float(
    "displacementedgescale",
    "scale of `edgelength` of all meshes",
    range = Range.above(0f)
  )(1f)
  private val reference =
    string("msereferenceimage", "reference image for `msereferenceout`", shown = "none")("")
  private val errors = string(
    "msereferenceout",
    "file for the MSE against `msereferenceimage` at 1, 2, 4, 8, … samples per pixel",
    shown = "none"
  )("")
  private val space = oneOf(
    "rendercoordsys",
    "which point the translations of moving instances are relative to: the world's origin, or " +
      "the camera",
    Seq("camera", "cameraworld", "world")
  )("cameraworld")
  noMeaning("`--aov` and `--report` show what pixels and rendering do")(
    bool("pixelstats", "write statistics images")(false)
  )
  noMeaning("the image is the same: pbrt's two renderers differ in speed")(
    bool("wavefront", "use the wavefront renderer")(false)
  )

  protected def create()(using site: Site): RenderSettings =
    val _ = space() // `Motions` reads it from the description
    for (one, other) <- Seq(reference -> errors, errors -> reference) do
      if one().nonEmpty && other().isEmpty then
        site.error(Code.ExclusiveParameters, s"option `${one.name}` needs `${other.name}`, too")
    RenderSettings(
      seed = seed(),
      centers = centers(),
      unfiltered = unfiltered(),
      oneColorSet = oneColorSet(),
      diffuse = diffuse(),
      edgeScale = edgeScale.given_(),
      output = OutputSettings(
        reference = placed(reference)((folder, name, at) =>
          folder.locate(name, Some(at)).fold(folder.path.resolve(name))(_.path).toString
        ),
        errors = placed(errors)((folder, name, _) => folder.path.resolve(name).toString)
      )
    )

  /** The name of a file, as pbrt relative to the current folder; of a confined scene, to its own.
    */
  private def placed(field: Field[String])(
      confined: (SceneFolder, String, SourcePos) => String
  )(using site: Site): Option[String] =
    val folder = site.declaration.folder
    for
      name <- field.given_().filter(_.nonEmpty)
      p <- site.declaration.param(field.name)
    yield
      if folder.isConfined && SceneFolder.isName(name) then confined(folder, name, p.valuesAt)
      else name

object OptionStatements:
  val all: Recipes[RenderSettings] = Recipes("option", Vector(OptionRecipe))

/** Colour spaces of v4's `ColorSpace`. */
object ColorSpaces:
  val all: Recipes[ColorSpace] = Recipes(
    "color space",
    ColorSpace.all.map(ColorSpaceRecipe(_))
  )

final class ColorSpaceRecipe(space: ColorSpace)
    extends Recipe[ColorSpace](space.name, space.meaning, onlyV4):
  protected def create()(using Site): ColorSpace = space
