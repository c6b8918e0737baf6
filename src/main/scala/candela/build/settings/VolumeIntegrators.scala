package candela.build

/** Recipes of v2's volume integrators. They matter to volumes alone. */
object VolumeIntegrators:
  val all: Recipes[Unit] = Recipes(
    "volume integrator",
    Vector(
      VolumeIntegrator("emission", "what volumes emit and absorb"),
      VolumeIntegrator("single", "the same, and light that is scattered once")
    )
  )

final class VolumeIntegrator(name: String, meaning: String)
    extends Recipe[Unit](name, meaning, onlyV2):
  noMeaning("volumes, which alone need it, are not rendered yet")(
    float("stepsize", "of a walk through a volume", unit = "scene units")(1f)
  )
  protected def make()(using Site): Unit = ()
