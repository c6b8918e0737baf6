package candela.build.integrators

import candela.bidirectional.{MetropolisSettings, PhotonSettings}
import candela.build.recipe.*
import candela.scenefile.Dialect

/** Integrators whose paths start at lights, too. */
object BdptRecipe extends IntegratorRecipe("bdpt", "paths from camera and lights, joined", sinceV3)
    with Windowed
    with Regularizing:
  notYet("the picture alone is written")(
    bool("visualizestrategies", "write an image for each way to join")(false),
    bool("visualizeweights", "write their weights")(false)
  )
  noMeaning("all of them have the same mean; light paths start by power")(
    string("lightsamplestrategy", "how lights are chosen: uniform, power, spatial", onlyV3)(
      "power"
    )
  )
  protected def make()(using Site): IntegratorPlan =
    windowed(BidirectionalPlans.plan(name, maxDepth(), regularize()))

object MltRecipe
    extends IntegratorRecipe(
      "mlt",
      "Metropolis light transport: chains of paths from camera and lights",
      sinceV3
    )
    with Regularizing:
  private val bootstrap = integer("bootstrapsamples", "paths to start with")(100000)
  private val chains = integer("chains", "Markov chains")(1000)
  private val mutations = integer("mutationsperpixel", "mutations of paths, for each pixel")(100)
  private val largeStep = float("largestepprobability", "of a path that is all new")(0.3f)
  private val sigma = float("sigma", "standard deviation of small mutations")(0.01f)

  protected def make()(using Site): IntegratorPlan =
    val settings = MetropolisSettings(bootstrap(), chains(), largeStep(), sigma())
    BidirectionalPlans.metropolis(name, maxDepth(), mutations(), settings, regularize())

object SppmRecipe extends IntegratorRecipe("sppm", "progressive photon mapping", sinceV3):
  private val passes = integer("numiterations", "passes", onlyV3)(64)
  private val passesToo = integer(
    "iterations",
    "another name of `numiterations`",
    onlyV3,
    shown = "numiterations"
  )(-1)
  private val photons =
    integer("photonsperiteration", "light paths of each pass", shown = "one a pixel")(-1)
  private val radius =
    float("radius", "in which photons are gathered at first", unit = "scene units")(1f)
  private val seed =
    integer("seed", "of the random numbers", onlyV4, shown = "the option's")(0)
  noMeaning("the image is written at the end")(
    integer("imagewritefrequency", "passes between images", onlyV3, shown = "never")(Int.MaxValue)
  )

  protected def make()(using site: Site): IntegratorPlan =
    val asked = if passesToo() > 0 then passesToo() else passes()
    // v4 takes as many as the sampler says
    val count = Option.when(site.dialect == Dialect.V3)(Math.max(1, asked))
    val settings =
      PhotonSettings(radius(), photons(), Math.max(0, maxDepth()), compresses = true, seed())
    PhotonPlans.plan(name, maxDepth(), settings, count)

object LightPathRecipe
    extends IntegratorRecipe("lightpath", "paths from the lights alone", onlyV4):
  override def pending: Option[String] =
    Some("\"bdpt\" is used: the same light, and that which is seen by way of mirrors or glass")
  protected def make()(using Site): IntegratorPlan = BidirectionalPlans.plan(name, maxDepth())

object FunctionRecipe
    extends Recipe[IntegratorPlan]("function", "no image: the error of samplers", onlyV4)
    with PathInstead:
  override def pending: Option[String] =
    Some("it makes no picture of the scene; the path integrator's is made")
  declare(
    oneOf(
      "function",
      "what is integrated",
      Vector("step", "diagonal", "disk", "checkerboard", "rotatedcheckerboard", "gaussian")
    )("step"),
    string("filename", "of the errors", shown = "function-mse.txt")(""),
    bool("skipbad", "leave out sample counts that the sampler does not like")(true),
    string("imagefilename", "of the function's picture", shown = "none")("")
  )
