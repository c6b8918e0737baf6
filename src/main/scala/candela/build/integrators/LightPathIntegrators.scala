package candela.build

import candela.bidirectional.BidirectionalPathTracer
import candela.integrators.VolumePathTracer
import candela.scenefile.Dialect

object Bdpt extends IntegratorRecipe("bdpt", "paths from camera and lights, joined", sinceV3):
  notYet("the picture alone is written")(
    bool("visualizestrategies", "write an image for each way to join")(false),
    bool("visualizeweights", "write their weights")(false)
  )
  noMeaning("all of them have the same mean; light paths start by power")(
    string("lightsamplestrategy", "how lights are chosen: uniform, power, spatial", onlyV3)(
      "power"
    )
  )
  notYet("BSDFs stay as they are")(
    bool("regularize", "roughen what a path meets late", onlyV4)(false)
  )
  windowed()

  /** Scattering events before a path may end by chance. */
  private val Patience = 4

  protected def make()(using site: Site): IntegratorPlan =
    val depth = Math.max(0, maxDepth())
    val isV4 = site.dialect == Dialect.V4
    IntegratorPlan(
      (scene, _) => BidirectionalPathTracer(scene, depth, Patience),
      samplesBsdf = false,
      s"bdpt, up to $depth scattering events",
      followsSpecular = isV4,
      throughMedia = Some: (scene, media) =>
        site.warn(
          "\"bdpt\" sees no media and no borders of media yet: \"volpath\" is used, the same " +
            "light but for lamps that are points and seen by way of mirrors or glass"
        )
        VolumePathTracer(scene, media, depth, if isV4 then 1 else 4, 1f, !isV4)
    )

/** Integrators whose paths start at lights, too, and are not there yet. */
object Mlt
    extends IntegratorRecipe("mlt", "Metropolis light transport", sinceV3)
    with PathInstead:
  override protected def seesMedia: Boolean = true
  declare(
    integer("bootstrapsamples", "paths to start with")(100000),
    integer("chains", "Markov chains")(1000),
    integer("mutationsperpixel", "mutations of paths, for each pixel")(100),
    float("largestepprobability", "of a path that is all new")(0.3f),
    float("sigma", "standard deviation of small mutations")(0.01f),
    bool("regularize", "roughen what a path meets late", onlyV4)(false)
  )
  override protected def depth()(using Site): Int = maxDepth()

object Sppm
    extends IntegratorRecipe("sppm", "progressive photon mapping", sinceV3)
    with PathInstead:
  declare(
    integer("numiterations", "passes", onlyV3)(64),
    integer("iterations", "another name of `numiterations`", onlyV3, shown = "numiterations")(64),
    integer("photonsperiteration", "photons of each pass", shown = "one a pixel")(-1),
    float("radius", "in which photons are gathered at first", unit = "scene units")(1f),
    integer("seed", "of the random numbers", onlyV4, shown = "the option's")(0)
  )
  noMeaning("the image is written at the end")(
    integer("imagewritefrequency", "passes between images", onlyV3, shown = "never")(Int.MaxValue)
  )
  override protected def depth()(using Site): Int = maxDepth()

object LightPath
    extends IntegratorRecipe("lightpath", "paths from the lights alone", onlyV4)
    with PathInstead:
  override protected def depth()(using Site): Int = maxDepth()

object FunctionIntegrator
    extends Recipe[IntegratorPlan]("function", "no image: the error of samplers", onlyV4)
    with PathInstead:
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
