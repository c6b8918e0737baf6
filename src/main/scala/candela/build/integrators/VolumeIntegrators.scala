package candela.build.integrators

import candela.build.recipe.*

/** How volumes are rendered.
  *
  * @param stepSize in scene units
  * @param scatters is light that comes from lights scattered by them?
  */
final case class VolumeMethod(stepSize: Float, scatters: Boolean):
  def describe: String =
    (if scatters then "emission and single scattering" else "emission") + s" in steps of $stepSize"

object VolumeMethod:
  /** Where v2 says nothing. */
  val Default: VolumeMethod = VolumeMethod(1f, scatters = false)

/** Recipes of v2's volume integrators. They matter to volumes alone. */
object VolumeIntegrators:
  val all: Recipes[VolumeMethod] = Recipes(
    "volume integrator",
    Vector(
      VolumeIntegratorRecipe("emission", "what volumes emit and absorb", scatters = false),
      VolumeIntegratorRecipe(
        "single",
        "the same, and light that is scattered once",
        scatters = true
      )
    )
  )

final class VolumeIntegratorRecipe(name: String, meaning: String, scatters: Boolean)
    extends Recipe[VolumeMethod](name, meaning, onlyV2):
  private val stepSize = float("stepsize", "of a walk through a volume", unit = "scene units")(1f)

  protected def make()(using site: Site): VolumeMethod =
    val size = stepSize()
    if size > 0f then VolumeMethod(size, scatters)
    else
      site.error(s"`stepsize` must be above 0, not $size")
      VolumeMethod(1f, scatters)
