package candela.build.integrators

import candela.photons.PhotonSettings
import candela.bsdf.{DiffuseEquivalent, Material}
import candela.build.materials.PlasticRecipe
import candela.build.recipe.*
import candela.color.Rgb
import candela.integrators.{DipoleLighting, DirectLighting}
import candela.render.RenderMethod
import candela.textures.{ConstantFloat, ConstantRgb}

/** Falls back to progressive photon mapping, with the same image and without final gathering. */
final class PhotonMapRecipe(name: String)
    extends Recipe[IntegratorPlan](
      name,
      "photon mapping; rendered by progressive photon mapping, with the same image",
      onlyV2
    ):
  private val bounces =
    integer("maxphotondepth", "maximum bounces of a photon", range = PathDepths)(5)
  private val specular =
    integer("maxspeculardepth", "maximum specular bounces", range = PathDepths)(5)
  private val radius =
    float(
      "maxdist",
      "initial search radius for photons",
      unit = "scene units",
      range = PhotonPlans.Radius
    )(0.1f)
  private val caustics =
    integer(
      "causticphotons",
      "caustic photons; 0: no caustics"
    )(20000)
  private val indirect =
    integer("indirectphotons", "indirect photons; 0: no indirect light")(100000)
  noMeaning("each sample traces new photons, and the radius shrinks")(
    integer("nused", "photons per estimate")(50),
    bool("finalgather", "gather indirect light from the next bounce")(true),
    integer("finalgathersamples", "final gather rays")(32),
    float("gatherangle", "maximum angle between gather rays and photons", unit = "degrees")(10f)
  )

  protected def create()(using Site): IntegratorPlan =
    val depth = Math.max(bounces(), specular()) + 1
    val settings = PhotonSettings(
      radius(),
      paths = -1,
      maxEdges = bounces(),
      compresses = false,
      caustics = caustics() > 0,
      indirect = indirect() > 0,
      gathersGloss = true
    )
    PhotonPlans.plan(name, depth, settings, passes = None)

object InstantGlobalIlluminationRecipe
    extends IntegratorRecipe("igi", "instant radiosity: virtual point lights", onlyV2)
    with PathInstead:
  declare(
    integer("nlights", "light paths per set")(64),
    integer("nsets", "sets of virtual lights")(4),
    float("rrthreshold", "contribution below which Russian roulette skips a light")(0.0001f),
    float("glimit", "maximum geometric term")(10f),
    integer("gathersamples", "rays that compensate for the limit")(16)
  )
  override def substitute: Option[String] =
    Some("using \"path\": all bounces as well, without the artefacts of virtual point lights")

  /** `maxdepth` counts specular bounces alone; paths to virtual lights have no limit. */
  override protected def depth()(using Site): Int = 1000

object IrradianceCacheRecipe
    extends Recipe[IntegratorPlan]("irradiancecache", "interpolated indirect light", onlyV2)
    with PathInstead:
  override def substitute: Option[String] =
    Some(
      "using \"path\" with as many bounces, which does not interpolate and includes glossy " +
        "indirect light"
    )
  private val bounces =
    integer("maxindirectdepth", "maximum diffuse bounces", range = PathDepths)(3)
  override protected def depth()(using Site): Int = 1 + bounces()
  declare(
    float("minweight", "minimum weight of a cached sample")(0.5f),
    float("minpixelspacing", "minimum distance of samples", unit = "pixels")(2.5f),
    float("maxpixelspacing", "maximum distance of samples", unit = "pixels")(15f),
    float("maxangledifference", "maximum angle between normals", unit = "degrees")(10f),
    integer("maxspeculardepth", "maximum specular bounces")(5),
    integer("nsamples", "rays per sample")(4096)
  )

object DipoleSubsurfaceRecipe
    extends IntegratorRecipe(
      "dipolesubsurface",
      "subsurface scattering by the dipole approximation",
      onlyV2
    ):
  noMeaning("points are sampled anew for each camera sample")(
    float("maxerror", "maximum solid angle of clustered points", unit = "sr")(0.05f),
    float("minsampledistance", "distance between surface points", unit = "scene units")(0.25f)
  )
  unsupported("irradiance is sampled over all surfaces, with new points")(
    string("pointsfile", "file of surface points", shown = "none")("")
  )

  protected def create()(using Site): IntegratorPlan =
    // Specular bounces; "directlighting" also counts the last surface
    val depth = maxDepth() + 1
    IntegratorPlan(
      (scene, samples) =>
        RenderMethod.tiles(scene): workerScene =>
          if scene.hasSubsurface then DipoleLighting(workerScene, depth, samples)
          else DirectLighting(workerScene, depth, samples),
      samplesBsdf = true,
      "dipolesubsurface, all lights at each point",
      goesBeneath = true,
      throughVolumes = Some((scene, samples, march) =>
        RenderMethod.tiles(scene): workerScene =>
          if scene.hasSubsurface then DipoleLighting(workerScene, depth, samples, march())
          else DirectLighting(workerScene, depth, samples, march())
      )
    )

/** Precomputed radiance transfer: the direct light that it stands for, with the surfaces that it
  * sees. What the spherical harmonics lose is kept: hard shadows, sharp reflection, and light that
  * differs from place to place.
  */
abstract class RadianceTransferRecipe(name: String, meaning: String)
    extends Recipe[IntegratorPlan](name, meaning, onlyV2):
  override def substitute: Option[String] =
    Some("using exact direct light, with hard shadows and lights at their places")
  declare(
    integer("lmax", "degree of the spherical harmonics")(4),
    integer("nsamples", "rays per point")(4096)
  )

  /** What it makes of the scene's materials. */
  protected def finish(using Site): Material => Material

  protected def create()(using Site): IntegratorPlan = IntegratorPlan(
    (scene, samples) => RenderMethod.tiles(scene)(DirectLighting(_, 1, samples)),
    samplesBsdf = true,
    s"directlighting for $name",
    finish = finish,
    throughVolumes = Some((scene, samples, march) =>
      RenderMethod.tiles(scene)(DirectLighting(_, 1, samples, march()))
    )
  )

object DiffusePrtRecipe
    extends RadianceTransferRecipe("diffuseprt", "precomputed diffuse transfer"):
  protected def finish(using Site): Material => Material =
    DiffuseEquivalent(_, transmits = false)

object GlossyPrtRecipe
    extends RadianceTransferRecipe("glossyprt", "precomputed transfer, of one glossy surface"):
  private val kd =
    color("Kd", "diffuse reflectance of all surfaces", SpectrumRole.Reflectance)(Rgb.gray(0.5f))
  private val ks =
    color("Ks", "glossy reflectance of all surfaces", SpectrumRole.Reflectance)(Rgb.gray(0.25f))
  private val roughness =
    float("roughness", "roughness of all surfaces", range = Range.nonNegative)(0.1f)
  protected def finish(using site: Site): Material => Material =
    val plastic =
      PlasticRecipe.second(ConstantRgb(kd()), ConstantRgb(ks()), ConstantFloat(roughness()))
    _ => plastic

object UseProbesRecipe
    extends Recipe[IntegratorPlan]("useprobes", "precomputed light probes", onlyV2)
    with PathInstead:
  override def substitute: Option[String] =
    Some("using \"path\", which needs no probe file and keeps all detail")
  declare(string("filename", "probe file")("probes.out"))

  /** As v2's "path" without parameters. */
  override protected def depth()(using Site): Int = 6
