package candela.build.recipe

import candela.guiding.GuideSettings
import candela.integrators.CausticsMode
import candela.math.Position

/** What holds for a whole scene: as its `Option` statements, the user's settings and its program's
  * rules say together.
  *
  * @param seed        of the scene, combined with that of the command line
  * @param centers     take all samples at the pixel centre, the middle of lens and shutter
  * @param unfiltered  point-sample textures
  * @param meanImages  replace image textures by their mean
  * @param oneColorSet take the same wavelengths for all samples
  * @param diffuse     make all materials diffuse
  * @param edgeScale   scale of `edgelength` of displaced meshes
  * @param reference   reference image of the errors to write
  * @param errors      file for the errors
  * @param rules       for all statements; else those of each statement's dialect
  * @param origin      where the origin of what is built lies in the scene's world
  * @param guiding     how paths learn where light comes from, if they do
  * @param caustics    whether light paths look for caustics
  */
final case class Switches(
    seed: Int = 0,
    centers: Boolean = false,
    unfiltered: Boolean = false,
    meanImages: Boolean = false,
    oneColorSet: Boolean = false,
    diffuse: Boolean = false,
    edgeScale: Option[Float] = None,
    reference: Option[String] = None,
    errors: Option[String] = None,
    rules: Option[Rules] = None,
    guiding: Option[GuideSettings] = None,
    caustics: CausticsMode = CausticsMode.Off,
    origin: Position = Position.Origin
)
