package candela.build

import candela.build.integrators.IntegratorPlan
import candela.color.Rgb
import candela.integrators.Headlight
import candela.render.RenderMethod
import candela.scenefile.Resolution

/** A first look at a scene, whatever its lights, media and integrator. */
private[build] object Preview:
  /** Largest number of pixels. */
  private val Pixels = 160_000

  def resolution(width: Int, height: Int): Resolution =
    Resolution.Percent(100 * Math.min(1, Math.sqrt(Pixels / (width.toDouble * height))))

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
