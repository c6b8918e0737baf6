package candela.gallery

import candela.build.SceneBuilder
import candela.render.{ReferenceScenes, RenderPlan}
import candela.scenefile.Parser
import candela.settings.RenderSettings

/** Scenes of the repository that the gallery shows beside pbrt's images of them.
  *
  * @param name   of the scene and its reference
  * @param effect what there is to see
  */
final case class Comparison(name: String, effect: String):
  /** File names of the images, without extension. */
  def own: String = s"scene-$name"
  def pbrt: String = s"scene-$name-pbrt"

  def plan(samples: Int): RenderPlan =
    val scene = Parser.parse(ReferenceScenes.Scenes.resolve(s"$name.pbrt"))
    SceneBuilder.build(scene, RenderSettings(samples = Some(samples)))._1

object Comparisons:
  val all: Vector[Comparison] = Vector(
    Comparison("v4-prism", "a prism throws the spectrum of a beam onto a wall, by `bdpt`"),
    Comparison("v4-dispersion", "glass whose index of refraction depends on the wavelength"),
    Comparison(
      "v4-spectral-fog",
      "blue fog around a warm bulb, a ball of dispersive glass, a coat of flint"
    ),
    Comparison("v4-spectral-lamps", "lights of many spectra on named metals and paints"),
    Comparison(
      "v4-color-spaces",
      "colours given in sRGB, DCI P3, BT.2020 and ACES2065-1; a film in BT.2020"
    ),
    Comparison("v4-sensor", "the response of a camera's sensor")
  )
