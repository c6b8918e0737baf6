package candela.build

import candela.bidirectional.{BidirectionalPathTracer, PhotonMapper, PhotonSettings}
import candela.integrators.{PathThroughVolumes, VolumePathTracer}
import candela.scenefile.Dialect

/** How [[BidirectionalPathTracer]] is made, for all that is rendered by it. */
private[build] object BidirectionalPlans:

  /** Scattering events before a path may end by chance. */
  private val Patience = 4

  /** @param name by which the scene asked for it */
  def plan(name: String, depth: Int)(using site: Site): IntegratorPlan =
    val most = Math.max(0, depth)
    val dialect = site.dialect
    val shown = if name == "bdpt" then name else s"bdpt for $name"
    IntegratorPlan(
      (scene, _) =>
        BidirectionalPathTracer(scene, most, Patience, compresses = dialect != Dialect.V2),
      samplesBsdf = false,
      s"$shown, up to $most scattering events",
      followsSpecular = dialect == Dialect.V4,
      throughMedia = Option.when(dialect != Dialect.V2): (scene, media) =>
        site.warn(
          s"\"$name\" sees no media and no borders of media yet: \"volpath\" is used, $Lack"
        )
        val patience = if dialect == Dialect.V4 then 1 else Patience
        VolumePathTracer(scene, media, most, patience, 1f, dialect == Dialect.V3)
      ,
      throughVolumes = Some: (scene, _, march) =>
        site.warn(s"\"$name\" sees no volumes yet: \"path\" is used, $Lack")
        PathThroughVolumes(scene, march, most, Patience, 1f)
    )

  private val Lack =
    "the same light but for that of lamps that are points, by way of mirrors or glass"

/** How [[PhotonMapper]] is made. */
private[build] object PhotonPlans:

  /** @param depth  most edges of a light path, and scattering events of one from the camera
    * @param paths  from the lights in each pass; at most 0: one for each pixel
    * @param passes if the scene says how many
    */
  def plan(name: String, depth: Int, radius: Float, paths: Int, passes: Option[Int], seed: Int)(
      using site: Site
  ): IntegratorPlan =
    val most = Math.max(0, depth)
    if !(radius > 0f) then site.error("photons need a radius above 0")
    val settings =
      PhotonSettings(
        radius,
        paths,
        most,
        compresses = site.dialect != Dialect.V2,
        seed ^ site.resources.seed
      )
    val bidirectional = BidirectionalPlans.plan(name, most)
    bidirectional.copy(
      make = (scene, _) => PhotonMapper(scene, most, settings),
      describe = s"$name, up to $most scattering events, photons within $radius at first",
      samples = passes,
      throughMedia = None
    )
