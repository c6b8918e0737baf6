package candela.build.integrators

import candela.bidirectional.PhotonSettings
import candela.build.recipe.*
import candela.color.Rgb
import candela.integrators.{DipoleLighting, DirectLighting}
import candela.render.RenderMethod

/** By progressive photon mapping, which comes to the same picture without final gathering. */
final class PhotonMapRecipe(name: String)
    extends Recipe[IntegratorPlan](
      name,
      "photon mapping with final gathering: by progressive photon mapping, to the same picture",
      onlyV2
    ):
  private val bounces = integer("maxphotondepth", "most bounces of a photon")(5)
  private val specular = integer("maxspeculardepth", "most specular bounces")(5)
  private val radius =
    float("maxdist", "within which photons are sought", unit = "scene units")(0.1f)
  private val caustics =
    integer(
      "causticphotons",
      "photons that came by mirrors and glass; 0: without that light"
    )(20000)
  private val indirect =
    integer("indirectphotons", "other photons; 0: without indirect light")(100000)
  noMeaning("photons are sent out for each sample anew, and the radius shrinks")(
    integer("nused", "photons of each estimate")(50),
    bool("finalgather", "is indirect light gathered at one remove?")(true),
    integer("finalgathersamples", "rays of each gathering")(32),
    float("gatherangle", "between gathering rays and photons", unit = "degrees")(10f)
  )

  protected def make()(using Site): IntegratorPlan =
    val depth = Math.max(bounces(), specular()) + 1
    val settings = PhotonSettings(
      radius(),
      paths = -1,
      maxEdges = Math.max(0, bounces()),
      compresses = false,
      caustics = caustics() > 0,
      indirect = indirect() > 0
    )
    PhotonPlans.plan(name, depth, settings, passes = None)

object InstantGlobalIlluminationRecipe
    extends IntegratorRecipe("igi", "many point lights in place of indirect light", onlyV2)
    with PathInstead:
  declare(
    integer("nlights", "paths from the lights in each set")(64),
    integer("nsets", "sets of lights")(4),
    float("rrthreshold", "contribution below which a light may be left out")(0.0001f),
    float("glimit", "greatest geometric term")(10f),
    integer("gathersamples", "rays that make up for that limit")(16)
  )
  override def pending: Option[String] =
    Some("the path integrator is used: the same light, without the pattern of point lights")
  override protected def depth()(using Site): Int = maxDepth()

object IrradianceCacheRecipe
    extends Recipe[IntegratorPlan]("irradiancecache", "indirect light, interpolated", onlyV2)
    with PathInstead:
  override def pending: Option[String] =
    Some(
      "the path integrator is used: nothing is interpolated, and glossy surfaces reflect " +
        "indirect light, too"
    )
  declare(
    float("minweight", "of neighbours that are used")(0.5f),
    float("minpixelspacing", "least distance of samples", unit = "pixels")(2.5f),
    float("maxpixelspacing", "greatest distance of samples", unit = "pixels")(15f),
    float("maxangledifference", "between normals", unit = "degrees")(10f),
    integer("maxspeculardepth", "most specular bounces")(5),
    integer("maxindirectdepth", "most diffuse bounces")(3),
    integer("nsamples", "rays of each sample")(4096)
  )

object DipoleSubsurfaceRecipe
    extends IntegratorRecipe("dipolesubsurface", "light under surfaces, by a dipole", onlyV2):
  noMeaning("no points are laid out on surfaces beforehand: each sample draws its own")(
    float("maxerror", "solid angle up to which points are taken together", unit = "sr")(0.05f),
    float("minsampledistance", "between points on surfaces", unit = "scene units")(0.25f)
  )
  notYet("light enters all over the surfaces")(
    string("pointsfile", "file of points", shown = "none")("")
  )

  protected def make()(using Site): IntegratorPlan =
    // Specular bounces, where "directlighting" counts the last surface, too
    val depth = Math.max(0, maxDepth()) + 1
    IntegratorPlan(
      (scene, samples) =>
        RenderMethod.Tiles(
          if scene.hasSubsurface then DipoleLighting(scene, depth, samples)
          else DirectLighting(scene, depth, samples)
        ),
      samplesBsdf = true,
      "dipolesubsurface, all lights at each point",
      goesBeneath = true,
      throughVolumes = Some((scene, samples, march) =>
        if scene.hasSubsurface then DipoleLighting(scene, depth, samples, march)
        else DirectLighting(scene, depth, samples, march)
      )
    )

/** Of what is lit by harmonics: they hold the light that arrives directly. */
trait DirectInstead extends Recipe[IntegratorPlan]:
  protected def make()(using Site): IntegratorPlan = IntegratorPlan(
    (scene, samples) => RenderMethod.Tiles(DirectLighting(scene, 1, samples)),
    samplesBsdf = true,
    s"directlighting for $name",
    throughVolumes = Some(DirectLighting(_, 1, _, _))
  )

object DiffusePrtRecipe
    extends Recipe[IntegratorPlan]("diffuseprt", "diffuse transfer, precomputed", onlyV2)
    with DirectInstead:
  override def pending: Option[String] =
    Some(
      "direct lighting is used: its shadows are sharp, lights stay where they are, and surfaces " +
        "may be glossy"
    )
  declare(
    integer("lmax", "degree of the spherical harmonics")(4),
    integer("nsamples", "rays from each point")(4096)
  )

object GlossyPrtRecipe
    extends Recipe[IntegratorPlan]("glossyprt", "glossy transfer, precomputed", onlyV2)
    with DirectInstead:
  override def pending: Option[String] =
    Some(
      "direct lighting is used: its shadows are sharp, lights stay where they are, and surfaces " +
        "have materials of their own"
    )
  declare(
    integer("lmax", "degree of the spherical harmonics")(4),
    integer("nsamples", "rays from each point")(4096),
    color("Kd", "of all surfaces", SpectrumRole.Reflectance)(Rgb.gray(0.5f)),
    color("Ks", "of all surfaces", SpectrumRole.Reflectance)(Rgb.gray(0.25f)),
    float("roughness", "of all surfaces")(0.1f)
  )

object UseProbesRecipe
    extends Recipe[IntegratorPlan]("useprobes", "light from precomputed probes", onlyV2)
    with PathInstead:
  override def pending: Option[String] =
    Some("the path integrator is used: no file is read, and light arrives in full detail")
  declare(string("filename", "file of probes")("probes.out"))
