package candela.build

import candela.diagnostics.{Code, Suggest}
import candela.build.integrators.{IntegratorPlan, Surroundings, VolumeIntegrators, VolumeMethod}
import candela.build.media.{Media, Volumes}
import candela.build.recipe.*
import candela.integrators.VolumeMarch
import candela.math.Vec3
import candela.media.{Medium, MediumBorder, Region, Regions, SceneMedia}
import candela.scene.Scene
import candela.scenefile.*

/** Builds the participating media of a scene, as supported by its integrator. */
private[build] final class MediaBuilder(
    context: BuildContext,
    plan: IntegratorPlan
):
  import context.{description, problems}

  private def medium(m: MediumDescription, context: BuildContext): Option[Medium] =
    Media.all.build(context.stillSite(m.medium, m.mediumToWorld, "a medium")).flatten

  private val (empty, filled): (Vector[MediumDescription], Vector[(MediumDescription, Medium)]) =
    description.media.partitionMap(m => medium(m, context).map(m -> _).toRight(m))
  private val media: Array[Medium] = filled.map(_._2).toArray
  private val indexOf: Map[String, Int] =
    (empty.map(_.name -> -1) ++ filled.map(_._1.name).zipWithIndex).toMap

  private def regions(context: BuildContext): Array[Region] =
    description.volumes
      .flatMap: v =>
        Volumes.all.build(context.stillSite(v.light, v.lightToWorld, "a medium")).flatten
      .toArray

  private val regions: Array[Region] = regions(context)
  private val volumeMethod: VolumeMethod =
    description.volumeIntegrator
      .flatMap(d => VolumeIntegrators.all.build(context.site(d)))
      .getOrElse(VolumeMethod.Default)

  /** Whether any medium or volume emits light. */
  def isEmissive: Boolean = media.exists(_.isEmissive) || regions.exists(!_.emitted.isBlack)

  /** Whether the integrator shows light of media. */
  def glows(materials: MaterialTable): Boolean =
    def inMedia = plan.throughMedia.isDefined && isUsed(materials) && media.exists(_.isEmissive)
    def inVolumes = plan.throughVolumes.isDefined && regions.exists(!_.emitted.isBlack)
    inMedia || inVolumes

  private def isUsed(materials: MaterialTable): Boolean = camera >= 0 || materials.touchesMedia

  /** Index of the camera's medium; −1: none. */
  private val camera: Int =
    val pos = context.placeOf(description.camera)
    index(description.cameraMedium, pos)

  /** The media on both sides of a shape. */
  def border(s: ShapeDescription): MediumBorder =
    MediumBorder(index(s.insideMedium, s.shape.pos), index(s.outsideMedium, s.shape.pos))

  /** The interface, if the integrator supports media. */
  def supported(border: MediumBorder): MediumBorder =
    if plan.throughMedia.isDefined then border else MediumBorder(-1, -1)

  private def index(name: String, at: candela.diagnostics.SourcePos): Int =
    if name.isEmpty then -1
    else
      indexOf.getOrElse(
        name, {
          val message = s"medium `$name` is not defined"
          def help = Suggest.help(name, indexOf.keys)
          problems.unnamed(Code.Undefined, NameKind.Medium, at, message, StandIns.LeftOut, help)
          -1
        }
      )

  /** What the integrator is to render between the surfaces, and its description.
    *
    * @param pointLike lights without a surface, the last of the scene's lights
    * @param reach diameter of the scene
    */
  def surroundings(
      scene: Scene,
      pointLike: Vector[LightDescription],
      materials: MaterialTable,
      reach: Float
  ): (Surroundings, String) =
    val isUsed = this.isUsed(materials)
    warnOfBlindness(isUsed)
    if plan.entersMedia(scene, isUsed) then
      val eye = description.worldToCamera.start.inverse.point(Vec3.Zero)
      val lightMedia = pointLike.map(l => index(l.medium, l.light.pos)).toArray
      val lights = Array.fill(scene.lights.length - lightMedia.length)(-1) ++ lightMedia
      val sceneMedia = SceneMedia(media, materials.borders, camera, lights, eye, reach)
      (Surroundings.Media(sceneMedia), sceneMedia.describe)
    else if regions.nonEmpty && plan.throughVolumes.isDefined then
      val volumes = Regions(regions)
      val method = methodIn(volumes)
      (march(volumes, method), s"${volumes.describe}, ${method.describe}")
    else (Surroundings.Nothing, "none")

  private def methodIn(volumes: Regions) = volumeMethod.copy(stepSize = stepSize(volumes))

  private def march(volumes: Regions, method: VolumeMethod) =
    Surroundings.Volumes(VolumeMarch(_, volumes, method.stepSize, method.scatters))

  /** The same in another colour basis. */
  def inBasis(surroundings: Surroundings, context: BuildContext): Surroundings =
    surroundings match
      case Surroundings.Media(all) =>
        Surroundings.Media(all.inBasis(i => medium(filled(i)._1, context).get))
      case Surroundings.Volumes(_) =>
        val volumes = Regions(regions(context))
        march(volumes, methodIn(volumes))
      case Surroundings.Nothing => Surroundings.Nothing

  /** The step size that is asked for, if a ray can have so many. */
  private def stepSize(volumes: Regions): Float =
    val requested = volumeMethod.stepSize
    val minimum = volumes.extent / Regions.MaxStepsAcross
    if requested >= minimum || !minimum.isFinite then requested
    else
      problems.warn(
        Code.CorrectedValue,
        description.volumeIntegrator.map(_.pos),
        s"`stepsize` of $requested needs more than ${Regions.MaxStepsAcross} steps through the " +
          s"volumes; using $minimum"
      )
      minimum

  private def warnOfBlindness(isUsed: Boolean): Unit =
    val blind =
      (isUsed && plan.throughMedia.isEmpty) || (regions.nonEmpty && plan.throughVolumes.isEmpty)
    if blind then
      val positions = description.media.map(_.medium.pos) ++ description.volumes.map(_.light.pos)
      for at <- description.integrator.map(_.pos).orElse(positions.headOption) do
        problems.warn(
          Code.IntegratorLacks,
          at,
          "this integrator ignores participating media, as in pbrt",
          Option.when(description.dialect != Dialect.V2)("use \"volpath\"")
        )
