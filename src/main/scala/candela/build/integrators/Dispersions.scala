package candela.build.integrators

import candela.build.recipe.*
import candela.render.RenderMethod
import candela.sampling.Wavelengths
import candela.scene.Scene
import candela.scenefile.SceneDescription

/** What is made of glass that splits light into its colours. */
private[build] object Dispersions:

  /** For paths, if the scene has such glass. */
  def wavelengths(scene: Scene)(using site: Site): Option[Wavelengths] =
    Option.when(scene.isDispersive)(Wavelengths(site.resources.basis))

  /** In words; with a warning if the integrator can't. */
  def describe(
      scene: Scene,
      method: RenderMethod,
      description: SceneDescription,
      problems: Findings
  ): String =
    if !scene.isDispersive then "none"
    else if method.splitsLight then "paths take one wavelength where light is split"
    else
      for d <- description.integrator.orElse(description.camera) do
        problems.warn(
          d.at,
          "glass that splits light is not supported here yet: its index at 589 nm is used"
        )
      "left out: one index for all wavelengths"
