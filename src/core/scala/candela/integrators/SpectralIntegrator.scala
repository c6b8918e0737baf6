package candela.integrators

import candela.aov.LightParts
import candela.color.{Rgb, Wavelengths}
import candela.film.Splats
import candela.geometry.Ray
import candela.sampling.{SampleHash, Sampler}
import candela.scene.PathReport

/** Spectral rendering: each camera path takes one of several sets of wavelengths, and the
  * integrator whose scene has its colours at these. The radiance is in linear sRGB.
  *
  * Source: Wilkie et al., "Hero Wavelength Spectral Sampling", EGSR 2014.
  *
  * @param integrators of each basis
  * @param bases       which cover the visible range; see [[candela.color.Wavelengths.covering]]
  * @param report      of one path, if wanted
  */
final class SpectralIntegrator(
    integrators: Array[Integrator],
    bases: Array[Wavelengths],
    report: Option[PathReport] = None
) extends Integrator:
  private var current = 0
  private var components = Rgb.Black
  private val dividedLight: LightParts | Null = integrators(0).lightParts match
    case null => null
    case some: LightParts => LightParts(some.groups)

  override def lightParts: LightParts | Null = dividedLight

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    current = SpectralIntegrator.choose(sampler.next1D(), bases.length)
    for r <- report do r.components(bases(current))
    components = integrators(current).radiance(ray, sampler)
    if dividedLight != null then
      val source = integrators(current).lightParts
      if source != null then dividedLight.convert(source, bases(current))
    bases(current).toSrgb(components)

  override def lastWavelengths: Wavelengths = bases(current)
  override def lastComponents: Rgb = components

  def raysTraced: Long = integrators.iterator.map(_.raysTraced).sum
  override def lastMaterial: Int = integrators(current).lastMaterial

object SpectralIntegrator:
  /** Index of one of `count` bases.
    *
    * @param u uniform in [0, 1)
    */
  def choose(u: Float, count: Int): Int = Math.min((u * count).toInt, count - 1)

/** Makes them of the integrators of each basis. */
final class SpectralIntegrators(each: Vector[WorkerIntegrators], bases: Array[Wavelengths])
    extends WorkerIntegrators:
  def create(report: Option[PathReport]): SpectralIntegrator =
    SpectralIntegrator(each.map(_.create(report)).toArray, bases, report)

  def divideLight: Boolean = each.head.divideLight

/** Spectral rendering in passes: all samples of a pass take the same wavelengths.
  *
  * @param passes of each basis
  */
final class SpectralPasses(passes: Vector[SharedPasses], bases: Array[Wavelengths])
    extends SharedPasses:

  def integrator(report: Option[PathReport]): PassIntegrator =
    SpectralPasses.OfWorker(this, passes.map(_.integrator(report)).toArray, bases)

  def release(pass: Int): Unit = passes(basis(pass)).release(pass)

  /** Passes in turn take bases far apart. */
  private def basis(pass: Int): Int =
    SpectralIntegrator.choose(SampleHash.toUnit(Integer.reverse(pass)), passes.length)

object SpectralPasses:
  private final class OfWorker(
      shared: SpectralPasses,
      integrators: Array[PassIntegrator],
      bases: Array[Wavelengths]
  ) extends PassIntegrator:
    private var current = 0
    private var components = Rgb.Black

    def startPass(pass: Int, isStopped: () => Boolean): Boolean =
      if pass >= SharedPasses.MaxOpen then shared.release(pass - SharedPasses.MaxOpen)
      current = shared.basis(pass)
      integrators(current).startPass(pass, isStopped)

    def radiance(ray: Ray, sampler: Sampler): Rgb =
      components = integrators(current).radiance(ray, sampler)
      bases(current).toSrgb(components)

    override def lastWavelengths: Wavelengths = bases(current)
    override def lastComponents: Rgb = components

    def raysTraced: Long = integrators.iterator.map(_.raysTraced).sum
    override def lastMaterial: Int = integrators(current).lastMaterial

/** Splats of one basis. */
final class ConvertedSplats(splats: Splats, basis: Wavelengths) extends Splats:
  def countSample(): Unit = splats.countSample()

  def add(x: Float, y: Float, light: Rgb, group: Int): Unit =
    splats.add(x, y, basis.toSrgb(light), group)
    splats.addToBands(x, y, basis, light)

  override def addStrategy(x: Float, y: Float, light: Rgb, strategy: Int): Unit =
    splats.addStrategy(x, y, basis.toSrgb(light), strategy)

  /** None of these splats has another basis. */
  def addToBands(x: Float, y: Float, basis: Wavelengths, light: Rgb): Unit = ()
