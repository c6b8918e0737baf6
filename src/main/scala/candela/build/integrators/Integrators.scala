package candela.build

import candela.integrators.{DirectLighting, Integrator, PathTracer, Whitted}
import candela.scene.Scene
import candela.scenefile.Dialect

/** An integrator to be made once the scene is known.
  *
  * @param make         takes the scene and how often each light is to be sampled
  * @param samplesBsdf  does it find lights by BSDF sampling too? Then lights may leave some to that
  */
final case class IntegratorPlan(
    make: (Scene, Array[Int]) => Integrator,
    samplesBsdf: Boolean,
    describe: String
)

/** Recipes of integrators; v2 calls them surface integrators. */
object Integrators:
  val all: Recipes[IntegratorPlan] = Recipes(
    "integrator",
    Vector(
      Path("path", "path tracing", every),
      Path("volpath", "path tracing, through media", sinceV3),
      Direct,
      WhittedRecipe
    ),
    Vector(
      "bdpt", "mlt", "sppm", "ao", "ambientocclusion", "photonmap", "exphotonmap", "igi",
      "irradiancecache",
      "dipolesubsurface", "diffuseprt", "glossyprt", "useprobes", "lightpath", "simplepath",
      "simplevolpath", "randomwalk", "function", "metropolis"
    ).map(
      _ -> "the path integrator is used, which has the same mean where that one is unbiased"
    ).toMap
  )

  final class Path(name: String, meaning: String, dialects: Set[Dialect])
      extends Recipe[IntegratorPlan](name, meaning, dialects):
    private val maxDepth = integer("maxdepth", "most scattering events of a path")(5)
    private val threshold =
      float("rrthreshold", "throughput below which a path may end", onlyV3)(1f)
    private val lightSampler = string("lightsampler", "how lights are chosen", onlyV4)("bvh")
    private val strategy = string("lightsamplestrategy", "how lights are chosen", onlyV3)("spatial")
    notYet("BSDFs stay as they are")(
      bool("regularize", "roughen what a path meets late", onlyV4)(false)
    )
    notYet("the film's crop window is rendered")(
      integers("pixelbounds", "x0 x1 y0 y1: the part to render", onlyV3, "integer[4]", "all")
    )

    protected def make()(using site: Site): IntegratorPlan =
      // All of them have the same mean; Candela's tree serves for each
      val _ = (lightSampler(), strategy())
      // v2 lights one vertex more than it counts
      val depth = Math.max(0, maxDepth()) + (if site.dialect == Dialect.V2 then 1 else 0)
      val patience = if site.dialect == Dialect.V4 then 1 else 4
      IntegratorPlan(
        (scene, _) => PathTracer(scene, depth, patience, threshold()),
        samplesBsdf = true,
        s"path, up to $depth scattering events"
      )

  object Direct extends Recipe[IntegratorPlan](
        "directlighting",
        "light that comes straight from lights",
        untilV3
      ):
    private val maxDepth = integer("maxdepth", "most specular bounces, plus one")(5)
    private val strategy =
      oneOf("strategy", "which lights are sampled", Vector("all", "one", "weighted"))("all")
    notYet("the film's crop window is rendered")(
      integers("pixelbounds", "x0 x1 y0 y1: the part to render", onlyV3, "integer[4]", "all")
    )

    protected def make()(using Site): IntegratorPlan =
      val (depth, every) = (Math.max(1, maxDepth()), strategy() == "all")
      IntegratorPlan(
        (scene, samples) => DirectLighting(scene, depth, if every then samples else Array.empty),
        // Only when each light has its turn can one of them be left to BSDF sampling
        samplesBsdf = every,
        s"directlighting, ${if every then "all lights" else "one light"} at each point"
      )

  object WhittedRecipe
      extends Recipe[IntegratorPlan]("whitted", "mirrors, glass and hard shadows alone", untilV3):
    private val maxDepth = integer("maxdepth", "most specular bounces, plus one")(5)
    notYet("the film's crop window is rendered")(
      integers("pixelbounds", "x0 x1 y0 y1: the part to render", onlyV3, "integer[4]", "all")
    )

    protected def make()(using Site): IntegratorPlan =
      val depth = Math.max(1, maxDepth())
      IntegratorPlan((scene, _) => Whitted(scene, depth), samplesBsdf = false, "whitted")
