package candela.render

import candela.aov.*
import candela.cameras.{Camera, Shutter}
import candela.color.ColorBasis
import candela.film.*
import candela.image.Image
import candela.sampling.Sampler
import candela.lights.LightGroups
import candela.scene.SurfaceNames

/** A scene prepared for rendering: only the objects that it needs, each the simplest exact
  * specialisation.
  *
  * @param width             of the full image in pixels, of which `crop` is rendered
  * @param method            organisation of the samples
  * @param basis             colour basis of the method's radiance
  * @param limit             brightness limit of samples, if the scene sets one
  * @param development       post-processing from film to image
  * @param differentialScale scale of camera ray differentials; 0: the scene needs none
  * @param facts             readable summary of what the plan contains and ignores: (what, value)
  * @param shutter           shutter interval, if anything is animated; else all rays have the same
  *                          time
  * @param weighsFirst       whether the limit applies after the camera's weighting of the light,
  *                          rather than before
  * @param layers            requested AOVs, if any
  * @param sharesSamples     if true, a sample contributes to all pixels within the filter's radius;
  *                          otherwise to one, by filter importance sampling
  * @param bands             wavelength bands to accumulate, if rendering is spectral
  * @param isCentered        whether all samples are at the pixel centre
  * @param errors            where to write errors while rendering, if anywhere
  * @param fireflies         what is done about them; limited light is divided by its way
  * @param lights            number of lights
  * @param built             what the scene takes in memory, estimated, and its building in time
  * @param sampleWindow      pixels beyond which no samples are taken, if there are any
  * @param samples           samples per pixel to take, if not as many as the sampler's points are
  *                          made for
  * @param maxSamples        samples per pixel that are never exceeded, whatever viewers ask for
  * @param sight             what the camera can see
  * @param hidesSky          whether the camera sees no sky, though it lights the scene
  * @param adaptive          whether a pixel needs all samples, if it doesn't always; of [[Tiles]]
  */
final case class RenderPlan(
    width: Int,
    height: Int,
    crop: PixelBounds,
    camera: Camera,
    filter: Filter,
    sampler: Sampler,
    method: RenderMethod,
    basis: ColorBasis,
    limit: Option[SampleLimit],
    development: Development,
    filename: String,
    facts: Vector[(String, String)],
    differentialScale: Float = 0f,
    shutter: Option[Shutter] = None,
    weighsFirst: Boolean = true,
    layers: Option[LayerPlan] = None,
    sharesSamples: Boolean = false,
    bands: Option[SpectralBands] = None,
    isCentered: Boolean = false,
    errors: Option[ErrorFile] = None,
    fireflies: Fireflies = Fireflies.Kept,
    lights: Int = 0,
    built: Vector[Cost] = Vector.empty,
    sampleWindow: Option[PixelBounds] = None,
    samples: Option[Int] = None,
    maxSamples: Int = RenderPlan.Endless,
    sight: Option[Sight] = None,
    hidesSky: Boolean = false,
    adaptive: Option[AdaptiveSampling] = None
):
  /** What the rendering takes in memory, estimated, and has taken in time until it begins. */
  def costs: Costs = Costs() ++ (built ++ FilmSize.of(this))

  /** The strategies of connection that are told apart. */
  def strategies: Vector[StrategyLayer] =
    layers.toVector.flatMap(_.layers).collect { case s: StrategyLayer => s }

  /** Groups of lights that splats are told apart by. */
  def splatGroups: Int =
    layers.filter(_.layers.contains(Layer.Lights)).flatMap(_.groups).fold(1)(_.size)

  /** What `--explain` says of the plan: (what, value). */
  def features: Vector[(String, String)] =
    facts :+ ("samples" -> (if sharesSamples then "splatted under the filter"
                            else "one pixel each"))

  /** This plan with the method that its pilot chooses, if it has one. The choice depends on the
    * whole image, not on the part that is rendered.
    */
  def piloted: RenderPlan = method.pilot.fold(this): pilot =>
    val fullImage = PixelBounds(0, 0, width, height)
    val (choice, why) = pilot.run(view(Splats.Discarded).copy(crop = fullImage))
    val chosen = choice.fold(method.withoutPilot)(pilot.method)
    copy(
      method = chosen,
      sharesSamples = sharesSamples && chosen.canShareSamples,
      layers = layers.map(l => if chosen.dividesLight then l else l.copy(division = None)),
      facts = facts.map {
        case ("guiding", _) if chosen.blurs => "guiding" -> s"none: ${Passes.Unguided}"
        case other => other
      } :+ ("caustics" -> why)
    )

  /** Samples per pixel to take. */
  val samplesPerPixel: Int = samples.getOrElse(sampler.samplesPerPixel)

  /** Whether a limit sets the samples per pixel. */
  def isLimited: Boolean = samplesPerPixel == maxSamples

  /** Pixels whose samples contribute to `crop`: these and, if samples are shared, a border. */
  def sampled: PixelBounds =
    if !sharesSamples then crop
    else
      val reach = FilterReach(filter)
      val reached = PixelBounds(
        crop.x0 - reach.beyondX,
        crop.y0 - reach.beyondY,
        crop.x1 + reach.beyondX,
        crop.y1 + reach.beyondY
      )
      sampleWindow.fold(reached)(reached.intersection)

  /** Limit of a sample's indirect light, if there is one. */
  def indirectLimit: Option[SampleLimit] = fireflies match
    case Fireflies.Clamped(most) => SampleLimit.channels(most / development.scale)
    case _ => None

  /** The method's view of the plan.
    *
    * @param splats receives the splats of light paths
    */
  def view(splats: Splats): View =
    View(
      camera,
      splats,
      width,
      height,
      crop,
      filter,
      sampler.samplesPerPixel,
      shutter,
      differentialScale
    )

object RenderPlan:
  /** Samples per pixel of a rendering that something else ends. */
  val Endless: Int = Int.MaxValue

/** Errors to write while rendering: names of the reference image and of the file. */
final case class ErrorFile(reference: String, file: String)

/** The AOVs of an image, and the visible surface that they are computed from.
  *
  * @param names  legend of the identifiers
  * @param division groups of light, if the samples' light is divided
  */
final case class LayerPlan(
    layers: Vector[ImageLayer],
    surface: VisibleSurface,
    names: SurfaceNames = SurfaceNames.Empty,
    division: Option[LightGroups] = None
):
  /** Names of the light groups. */
  def groups: Option[Vector[String]] = division.map(_.names)

  def channels(layer: ImageLayer): Vector[String] = layer.channelsOf(groups.getOrElse(Vector.empty))

  /** Legends of the layers in the image. */
  def metadata(image: Image): Vector[(String, String)] = layers.flatMap:
    case Layer.CryptoObject => Cryptomatte.metadata("CryptoObject", names.objects, image)
    case Layer.CryptoMaterial => Cryptomatte.metadata("CryptoMaterial", names.materials, image)
    case _ => Vector.empty
