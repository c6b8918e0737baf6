package candela.render

import candela.cameras.Camera
import candela.color.Rgb
import candela.film.{BoxFilter, Development, Filter, Fireflies, PixelBounds, SampleLimit}
import candela.geometry.Ray
import candela.integrators.{Integrator, WorkerIntegrators}
import candela.math.Vec3
import candela.sampling.Sampler
import candela.scene.PathReport

/** Where an integrator of [[TinyPlan]] is asked for radiance. */
final case class Where(x: Int, y: Int, sample: Int)

/** Plans without a scene: the radiance is a formula. */
object TinyPlan:

  def apply(
      width: Int = 40,
      height: Int = 27,
      spp: Int = 5,
      crop: Option[PixelBounds] = None,
      limit: Option[SampleLimit] = None,
      filename: String = "pbrt.exr",
      filter: Filter = BoxFilter(0.5f, 0.5f),
      sharesSamples: Boolean = false,
      development: Development = Development(),
      fireflies: Fireflies = Fireflies.Kept,
      method: Option[RenderMethod] = None,
      adaptive: Option[AdaptiveSampling] = None
  )(radiance: (Where, Sampler) => Rgb): RenderPlan =
    val bounds = crop.getOrElse(PixelBounds(0, 0, width, height))
    RenderPlan(
      width,
      height,
      bounds,
      FlatCamera,
      filter,
      HashSampler(spp),
      method.getOrElse(Tiles(Formulas(radiance))),
      candela.color.ColorBasis.Srgb,
      limit,
      development,
      filename,
      Vector("integrator" -> "formula"),
      sharesSamples = sharesSamples,
      fireflies = fireflies,
      adaptive = adaptive
    )

  /** Rays start at the place on the film. */
  private object FlatCamera extends Camera:
    def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
      ray.set(Vec3(x, y, 0f), Vec3(0f, 0f, 1f), Float.PositiveInfinity)

  private def floor(v: Float): Int = Math.floor(v).toInt

  private final class Formulas(radiance: (Where, Sampler) => Rgb) extends WorkerIntegrators:
    def create(report: Option[PathReport]): Integrator = Formula(radiance)
    def divideLight: Boolean = false

  private final class Formula(radiance: (Where, Sampler) => Rgb) extends Integrator:
    private var rays = 0L
    def raysTraced: Long = rays
    def radiance(ray: Ray, sampler: Sampler): Rgb =
      rays += 1
      // A box filter of radius one half leaves samples in their pixel, as sharing does.
      sampler match
        case hash: HashSampler =>
          radiance(Where(floor(ray.ox), floor(ray.oy), hash.sample), sampler)

/** Independent samples that know their number. */
final class HashSampler(val samplesPerPixel: Int) extends Sampler:
  private var state = 0L
  var sample = 0

  def start(px: Int, py: Int, s: Int): Unit =
    sample = s
    state = (px * 7919L + py) * 104729L + s

  def next1D(): Float =
    // Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
    state += 0x9e3779b97f4a7c15L
    var z = state
    z = (z ^ (z >>> 30)) * 0xbf58476d1ce4e5b9L
    z = (z ^ (z >>> 27)) * 0x94d049bb133111ebL
    ((z ^ (z >>> 31)) >>> 40) / 16777216f // 2²⁴

  def next2D(): Unit =
    x = next1D()
    y = next1D()

  def copy(): HashSampler = HashSampler(samplesPerPixel)
