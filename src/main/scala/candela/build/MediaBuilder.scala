package candela.build

import candela.base.Suggest
import candela.bsdf.{InterfaceMaterial, Material}
import candela.build.integrators.{IntegratorPlan, VolumeIntegrators, VolumeMethod}
import candela.build.media.{Media, Volumes}
import candela.build.recipe.*
import candela.integrators.VolumeMarch
import candela.media.{Medium, MediumBorder, Region, Regions, SceneMedia}
import candela.render.RenderMethod
import candela.scene.Scene
import candela.scenefile.*

/** What fills the space between a scene's surfaces, as far as its integrator sees it. */
private[build] final class MediaBuilder(
    description: SceneDescription,
    plan: IntegratorPlan,
    resources: Resources,
    problems: Findings
):
  private def site(d: Declaration, toWorld: AnimatedTransform): Site =
    if toWorld.isAnimated then problems.warn(d.at, Motions.stands("a medium"))
    Site(d, description.dialect, resources, problems, toWorld.start)

  private val made: Vector[(String, Option[Medium])] =
    description.media.map(m => m.name -> Media.all.build(site(m.medium, m.mediumToWorld)).flatten)
  private val media: Array[Medium] = made.flatMap(_._2).toArray
  private val indexOf: Map[String, Int] =
    made.map((name, medium) => name -> medium.fold(-1)(m => media.indexWhere(_ eq m))).toMap

  private val regions: Array[Region] =
    description.volumes
      .flatMap(v => Volumes.all.build(site(v.light, v.lightToWorld)).flatten)
      .toArray
  private val volumeMethod: VolumeMethod =
    description.volumeIntegrator
      .flatMap(d => VolumeIntegrators.all.build(Site(d, description.dialect, resources, problems)))
      .getOrElse(VolumeMethod.Default)

  private var isUsed = false

  /** Index of the medium around the camera. */
  val camera: Int =
    val at = description.camera.fold(SceneBuilder.NoPlace)(_.at)
    seen(index(description.cameraMedium, at))

  /** The media on both sides of a shape. */
  def border(s: ShapeDescription): MediumBorder =
    MediumBorder(
      seen(index(s.insideMedium, s.shape.at)),
      seen(index(s.outsideMedium, s.shape.at))
    )

  /** Volumes of pbrt-v2 have no borders: a surface that all light passes is no surface there. */
  def isNothing(material: Material): Boolean =
    description.dialect == Dialect.V2 && (material eq InterfaceMaterial)

  private def seen(medium: Int): Int =
    isUsed ||= medium >= 0
    if plan.throughMedia.isDefined then medium else -1

  private def index(name: String, at: candela.base.SourcePos): Int =
    if name.isEmpty then -1
    else
      indexOf.getOrElse(
        name, {
          val message = s"no medium is named `$name`"
          val help = Suggest.help(name, indexOf.keys)
          problems.unnamed(NameKind.Medium, at, message, StandIns.LeftOut, help)
          -1
        }
      )

  /** @param borders by index of the scene's materials
    * @param reach   diameter of the scene
    */
  def method(
      scene: Scene,
      lightSamples: Array[Int],
      borders: Array[MediumBorder],
      hasInterfaces: Boolean,
      reach: Float
  ): (RenderMethod, String) =
    warnOfBlindness()
    (plan.throughMedia, plan.throughVolumes) match
      case (Some(make), _) if isUsed || hasInterfaces =>
        val all = SceneMedia(media, borders, camera, reach, hasInterfaces)
        (RenderMethod.Tiles(make(scene, all)), all.describe)
      case (_, Some(make)) if regions.nonEmpty =>
        val volumes = Regions(regions)
        val march = VolumeMarch(scene, volumes, volumeMethod.stepSize, volumeMethod.scatters)
        val integrator = make(scene, lightSamples, march)
        (RenderMethod.Tiles(integrator), s"${volumes.describe}, ${volumeMethod.describe}")
      case _ => (plan.method(scene, lightSamples), "none")

  private def warnOfBlindness(): Unit =
    val blind =
      (isUsed && plan.throughMedia.isEmpty) || (regions.nonEmpty && plan.throughVolumes.isEmpty)
    if blind then
      val places = description.media.map(_.medium.at) ++ description.volumes.map(_.light.at)
      for at <- description.integrator.map(_.at).orElse(places.headOption) do
        problems.warn(
          at,
          "this integrator does not see the media of the scene, as in pbrt",
          Option.when(description.dialect != Dialect.V2)("\"volpath\" does")
        )
