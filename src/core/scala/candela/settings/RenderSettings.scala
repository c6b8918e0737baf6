package candela.settings

import candela.aov.Layer
import candela.color.Rgb
import candela.film.{Fireflies, PixelBounds}
import candela.guiding.{GuideSettings, GuidingMode}
import candela.image.DisplayTransform
import candela.integrators.CausticsMode
import candela.scenefile.{Dialect, Resolution}

/** Settings that affect the image. With the scene's files, they identify a rendering:
  * [[SettingsCodec]] stores each of them.
  *
  * @param samples     per pixel, instead of the scene's
  * @param goal        what ends the rendering before its samples do
  * @param quick       if true, renders a sixteenth of the pixels with one sample each, where no
  *                    other numbers are asked for
  * @param preview     if true, reduces the image and shades it by a headlight, whatever the scene's
  *                    integrator, lights and film
  * @param region      part of the image to render, instead of the scene's
  * @param layers      AOVs, in addition to the scene's
  * @param lightGroups how to group lights for their layer
  * @param color       whether rendering is spectral
  * @param points      which sample points to take, if asked for: else [[Choices]]
  * @param fireflies   what is done about them
  * @param guiding     whether paths learn where light comes from, likewise
  * @param caustics    whether light paths or photons look for caustics, likewise
  * @param centers     take all samples at the pixel centre, the middle of lens and shutter
  * @param unfiltered  point-sample textures
  * @param meanImages  replace image textures by their mean
  * @param oneColorSet take the same wavelengths for all samples
  * @param diffuse     make all materials diffuse
  * @param sky         whether the camera sees the sky, if asked for
  * @param edgeScale   scale of `edgelength` of displaced meshes
  * @param reading     how the scene's files are read
  * @param output      what is written of the image
  */
final case class RenderSettings(
    samples: Option[Int] = None,
    seed: Int = 0,
    goal: RenderGoal = RenderGoal(),
    quick: Boolean = false,
    preview: Boolean = false,
    region: RenderRegion = RenderRegion.Whole,
    layers: Vector[Layer] = Vector.empty,
    lightGroups: Option[LightGrouping] = None,
    color: ColorMode = ColorMode.Auto,
    points: Option[PointChoice] = None,
    fireflies: Fireflies = Fireflies.Kept,
    guiding: Option[GuidingMode] = None,
    caustics: Option[CausticsMode] = None,
    centers: Boolean = false,
    unfiltered: Boolean = false,
    meanImages: Boolean = false,
    oneColorSet: Boolean = false,
    diffuse: Boolean = false,
    sky: Option[SkyView] = None,
    edgeScale: Option[Float] = None,
    reading: ReadSettings = ReadSettings(),
    output: OutputSettings = OutputSettings()
):
  /** With these layers, too; whether each is stored in 16 bits, where that is said. */
  def adding(more: Seq[(Layer, Option[Boolean])]): RenderSettings =
    val layerPrecisions = more.collect { case (layer, Some(isHalf)) => layer -> isHalf }
    val precise = output.copy(precisions = output.precisions ++ layerPrecisions)
    copy(layers = layers ++ more.map(_._1), output = precise)

  /** With the denoised image, and the layers that guide the denoiser. */
  def denoised: RenderSettings =
    copy(output = output.copy(denoise = true), layers = (layers ++ Layer.denoising).distinct)

  /** Whether only a goal ends the rendering. */
  def isEndless: Boolean = goal.isGiven && samples.isEmpty

  /** These, and what is chosen where nothing was asked for. */
  def choices: Choices = Choices.of(this)

  /** The same rendering, whatever goal is set later. */
  def chosen: RenderSettings = choices.applyTo(this)

  /** A preview shows albedos, for which three numbers do. */
  def colorMode: ColorMode = if preview then ColorMode.Rgb else color

  /** How paths learn where light comes from, if they do. */
  def learning: Option[GuideSettings] =
    val chosen = choices
    val endsOpen = isEndless || chosen.points == PointChoice.Progressive
    GuideSettings.of(chosen.guiding, endsOpen)

  /** Both these and what the scene's own `Option` statements set; where they differ, these. Seeds
    * are combined.
    */
  def overriding(scene: RenderSettings): RenderSettings = copy(
    seed = seed ^ scene.seed,
    centers = centers || scene.centers,
    unfiltered = unfiltered || scene.unfiltered,
    oneColorSet = oneColorSet || scene.oneColorSet,
    diffuse = diffuse || scene.diffuse,
    edgeScale = edgeScale.orElse(scene.edgeScale),
    output = output.copy(
      reference = output.reference.orElse(scene.output.reference),
      errors = output.errors.orElse(scene.output.errors)
    )
  )

/** Time or error that ends a rendering.
  *
  * @param time  in seconds
  * @param error relative error
  */
final case class RenderGoal(time: Option[Double] = None, error: Option[Double] = None):
  def isGiven: Boolean = time.isDefined || error.isDefined

/** Part of an image. */
enum RenderRegion:
  /** All of it, or the part that the scene asks for. */
  case Whole

  /** In fractions [0, 1] of width and height. */
  case Window(x0: Float, x1: Float, y0: Float, y1: Float)

  /** In pixels. */
  case Pixels(bounds: PixelBounds)

  case Pixel(x: Int, y: Int)

  /** Its pixels, if they do not depend on the size of the image. */
  def pixels: Option[PixelBounds] = this match
    case Pixels(bounds) => Some(bounds)
    case Pixel(x, y) => Some(PixelBounds(x, y, x + 1, y + 1))
    case Whole | Window(_, _, _, _) => None

/** How the files of a scene are read.
  *
  * @param dialect   instead of the one that they seem to be of
  * @param defines   parameters of a Mitsuba scene, by name
  * @param keepGoing whether to replace missing items by placeholders
  * @param sensors   of a scene that may have several; none: the first
  * @param resolution in place of the film's: some formats' views depend on its aspect ratio
  * @param model     how a model is shown
  * @param camera    file with a camera in place of the scene's
  */
final case class ReadSettings(
    dialect: Option[Dialect] = None,
    defines: Map[String, String] = Map.empty,
    keepGoing: Boolean = false,
    sensors: Option[Sensors] = None,
    resolution: Option[Resolution] = None,
    model: ModelSettings = ModelSettings(),
    camera: Option[String] = None
)

/** How a model is shown, instead of as it is.
  *
  * @param light      what lights it
  * @param background what is behind and below it
  * @param turntable  number of images, between which it turns around once
  * @param state      which of its states is shown
  * @param up         which of its axes points up, if its format leaves that open
  */
final case class ModelSettings(
    light: Option[ModelLight] = None,
    background: Option[ModelGround] = None,
    turntable: Option[Int] = None,
    state: ModelState = ModelState(),
    up: Option[UpAxis] = None
):
  /** Whether there is an image of each of several views or times. */
  def hasSeveralImages: Boolean = turntable.nonEmpty || state.times.exists(_.count > 1)

/** The axis of a model that points up. */
enum UpAxis:
  case Y, Z

/** A state of a model that has several.
  *
  * @param times     of an animation, an image each; none: at rest
  * @param animation name or index of that animation; none: the first
  * @param variant   name of a variant of its materials
  */
final case class ModelState(
    times: Option[ModelTimes] = None,
    animation: Option[String] = None,
    variant: Option[String] = None
)

/** Times at equal distances, in seconds. */
final case class ModelTimes(first: Double, step: Double, count: Int):
  def apply(i: Int): Double = first + i * step

object ModelTimes:
  val MaxCount: Int = 10000
  def at(time: Double): ModelTimes = ModelTimes(time, 0, 1)

/** What lights a model. */
enum ModelLight:
  case Studio, Sky

  /** @param file an image of all directions */
  case Surroundings(file: String)

  /** Whether the model stands on something below it. */
  def hasGround: Boolean = this match
    case Studio | Sky => true
    case Surroundings(_) => false

/** What is behind and below a model. */
enum ModelGround:
  case Empty

  /** A ground of a linear colour of sRGB. */
  case Colored(color: Rgb)

/** The sensors of a scene that are rendered. */
enum Sensors:
  case All

  /** @param index from 0 on */
  case One(index: Int)

/** Output settings of an image.
  *
  * @param precisions whether layers are stored in 16 bits, where asked
  * @param denoise    whether a denoised image is added
  * @param storeTime  whether the render time is stored in the image file
  * @param display    how pictures show linear light
  * @param reference  reference image of `errors`
  * @param errors     file for the MSE at 1, 2, 4, 8, … samples per pixel
  */
final case class OutputSettings(
    precisions: Map[Layer, Boolean] = Map.empty,
    denoise: Boolean = false,
    storeTime: Boolean = false,
    display: DisplayTransform = DisplayTransform.Plain,
    reference: Option[String] = None,
    errors: Option[String] = None
)
