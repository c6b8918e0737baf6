package candela.render

import candela.color.Rgb
import candela.geometry.{Hit, Ray}
import candela.sampling.Sampler
import candela.scene.Scene

/** Takes few samples of each pixel. Where these differ, they are thrown away, and those of the
  * plan's sampler are taken instead.
  *
  * Few samples that agree by chance count, so the image is biased: what is rare counts too little.
  *
  * Source: pbrt-v2, sampler "adaptive"; Pharr, Humphreys, "Physically Based Rendering", 2nd ed.
  * 2010, §7.5.
  *
  * @param first samples these few
  */
final case class AdaptiveSampling(first: Sampler, difference: SampleDifference)

/** What makes samples of a pixel differ. */
enum SampleDifference:
  /** A luminance differs from the mean by more than half of it. */
  case Contrast

  /** Camera rays meet several triangles or other primitives. */
  case Shape(scene: Scene)

/** The first samples of a pixel. Mutable, one per worker. */
private[render] final class FirstSamples(adaptive: AdaptiveSampling):
  import FirstSamples.MaxContrast
  val sampler: Sampler = adaptive.first.copy()
  val count: Int = sampler.samplesPerPixel
  private val lights = Array.fill(count)(Rgb.Black)
  private var size = 0

  private val scene: Scene | Null = adaptive.difference match
    case SampleDifference.Shape(scene) => scene
    case SampleDifference.Contrast => null
  private val ray = Ray()
  private val hit = Hit()
  private var primitive, inner = -1
  private var hasSeveralShapes = false

  def clear(): Unit =
    size = 0
    hasSeveralShapes = false

  /** Adds a sample that no ray belongs to. */
  def addBlocked(): Unit =
    hit.primitive = -1
    hit.inner = -1
    addHit()
    add(Rgb.Black)

  /** Finds the shape that a camera ray meets, if it matters; before its light is added. Leaves the
    * ray unchanged.
    */
  def traceFirstHit(camera: Ray): Unit =
    val world = scene
    if world != null then
      ray.set(camera.origin, camera.direction, Float.PositiveInfinity)
      ray.time = camera.time
      hit.primitive = -1
      hit.inner = -1
      val _ = world.closest(ray, hit)
      addHit()

  private def addHit(): Unit =
    if size == 0 then
      primitive = hit.primitive
      inner = hit.inner
    else if hit.primitive != primitive || hit.inner != inner then hasSeveralShapes = true

  def add(light: Rgb): Unit =
    lights(size) = light
    size += 1

  /** The light of a sample that was added. */
  def light(i: Int): Rgb = lights(i)

  def differ: Boolean = if scene != null then hasSeveralShapes else contrasts

  private def contrasts: Boolean =
    var sum = 0f
    var i = 0
    while i < size do
      sum += luminance(i)
      i += 1
    val mean = sum / size
    i = 0
    // Without light, the quotient is not a number, and nothing differs
    while i < size && !(Math.abs(luminance(i) - mean) / mean > MaxContrast) do i += 1
    i < size

  /** Samples that are discarded count as black. */
  private def luminance(i: Int): Float = if lights(i).isFinite then lights(i).luminance else 0f

private[render] object FirstSamples:
  /** Of a sample's luminance to the mean, relative to the mean. */
  private val MaxContrast = 0.5f
