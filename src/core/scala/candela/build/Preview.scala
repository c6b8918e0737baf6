package candela.build

import candela.build.integrators.IntegratorPlan
import candela.color.Rgb
import candela.integrators.Headlight
import candela.render.RenderMethod

/** A first look at a scene, whatever its lights, media and integrator. */
private[build] object Preview:
  /** Largest number of pixels. */
  private val Pixels = 160_000

  /** By how much the width and the height of an image are divided. */
  def reduction(width: Int, height: Int): Int =
    Math.ceil(Math.sqrt(width.toDouble * height / Pixels)).toInt

  def integrator(context: BuildContext): IntegratorPlan =
    val white = context.resources.basis.fromSrgb(Rgb.White)
    IntegratorPlan(
      (scene, _) => RenderMethod.tiles(scene)(Headlight(_, white)),
      samplesBsdf = false,
      "headlight shading",
      followsSpecular = false,
      isLit = false,
      throughMedia = Some((scene, _) => RenderMethod.tiles(scene)(Headlight(_, white))),
      throughVolumes = Some((scene, _, _) => RenderMethod.tiles(scene)(Headlight(_, white)))
    )
