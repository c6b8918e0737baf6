package candela.build

import java.util.Locale

import candela.build.recipe.Rules
import candela.color.{CameraSensor, ColorError, SmoothSpectra, Wavelengths}
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.ColorMode

/** What the paths of a scene carry, and why.
  *
  * @param bases of spectral rendering; none: three numbers
  */
private[build] final case class ColorPlan(bases: Vector[Wavelengths], describe: String):
  def isSpectral: Boolean = bases.nonEmpty

  /** All paths carry the same wavelengths, of the middle set. */
  def ofOneSet: ColorPlan =
    if !isSpectral then this
    else ColorPlan(Vector(bases(bases.size / 2)), s"$describe; always the same three")

private[build] object ColorPlan:

  /** pbrt-v2, v3 and glTF multiply three numbers. */
  def mode(asked: ColorMode, scene: SceneDescription): ColorMode =
    val isSpectral = Rules.of(scene.dialect).isSpectral || disperses(scene)
    if asked == ColorMode.Auto && !isSpectral then ColorMode.Rgb else asked

  /** Whether materials of a model say so; those of pbrt have spectra as indices instead. */
  private def disperses(scene: SceneDescription): Boolean =
    scene.dialect == Dialect.Gltf &&
      scene.namedMaterials.exists(_._2.param("dispersion").isDefined)

  /** Decides once the scene is built in three numbers.
    *
    * @param camera the sensor, unless it is the standard observer
    */
  def of(context: BuildContext, asked: ColorMode, camera: Option[CameraSensor]): ColorPlan =
    val census = context.resources.census
    val (least, uniform) = census.bands.fold((UsualSets, Wavelengths.Uniform))(n => (4 * n, 1.0))
    def spectral(why: String) =
      val smooth = SmoothSpectra()
      val (lights, surfaces) = (census.lights, census.surfaces)
      val light = census.light
      val fewest = Math.max(if census.isDispersive then DispersionSets else UsualSets, least)
      val observed =
        Iterator
          .iterate(fewest)(2 * _)
          .map(Wavelengths.covering(_, smooth, light))
          .find(bases =>
            bases.size >= MaxSets ||
              ColorError.ofWavelengths(bases, lights, surfaces) < LineTolerance
          )
          .get
      val count = observed.size
      val bases =
        if camera.isEmpty && census.bands.isEmpty then observed
        else
          val detector = camera.fold(Wavelengths.Observer)(_.responses)
          Wavelengths.covering(count, smooth, light, detector, uniform)
      ColorPlan(bases, s"spectral, three of ${3 * count} wavelengths a path: $why")
    mode(asked, context.description) match
      case ColorMode.Spectral => spectral("as requested")
      case ColorMode.Rgb if asked == ColorMode.Rgb =>
        ColorPlan(Vector.empty, "three numbers: as requested")
      case ColorMode.Rgb =>
        ColorPlan(Vector.empty, s"three numbers: as in ${context.rules.program}")
      case ColorMode.Auto if census.isDispersive => spectral("glass disperses light")
      case ColorMode.Auto if census.detectors.isDefined => spectral(census.detectors.get)
      case ColorMode.Auto =>
        val basis = context.resources.plainBasis
        val error = ColorError.bound(census.lights, census.surfaces, basis, Bounces)
        val percent = String.format(Locale.ROOT, "%.1f", error * 100)
        if error < Tolerance then
          ColorPlan(Vector.empty, s"three numbers: off by $percent % at most")
        else spectral(s"three numbers may be off by $percent %")

  /** Error of a channel above which rendering is spectral. */
  private val Tolerance = 0.005

  /** Scattering events of a path that matter for its colour. */
  private val Bounces = 12

  /** Number of sets of three wavelengths. */
  private val UsualSets = 64

  /** … if glass disperses light. */
  private val DispersionSets = 256

  /** … at most, for spectra of narrow lines. */
  private val MaxSets = 512

  /** Error of a channel above which spectra need more wavelengths. */
  private val LineTolerance = 0.003
