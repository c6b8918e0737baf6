package candela.bsdf

import candela.color.{MutableRgb, Rgb}
import candela.math.*

/** How a point of a surface scatters light. Directions are unit vectors that point away from the
  * surface, in a local frame whose +z is the shading normal. `wo` is where the radiance goes (to
  * the camera), `wi` where it comes from. Immutable.
  */
abstract class Bsdf:

  /** The value in sr⁻¹, without the cosine; black for perfectly specular scattering. */
  def f(wo: Vec3, wi: Vec3): Rgb

  /** The density, per solid angle, with which `sample` returns `wi`; 0 for specular scattering. */
  def pdf(wo: Vec3, wi: Vec3): Float

  /** Draws `wi` for `wo`.
    *
    * @param choice picks between lobes, in [0, 1)
    * @return [[BsdfSample.Absorbed]] if nothing is scattered
    */
  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample

  /** The same, written to `out`. */
  def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    out.take(sample(wo, choice, u1, u2))

  /** Draws among the perfectly specular directions only: what Whitted's recursion follows. */
  def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    if isSpecular then sample(wo, choice, 0.5f, 0.5f) else BsdfSample.Absorbed

  /** Only perfectly specular scattering: light sampling can't help. */
  def isSpecular: Boolean

  /** Does it scatter to the other side of the surface? */
  def isTransmissive: Boolean

  /** The same with its sharp lobes widened, so that light sampling finds what only chance would:
    * for vertices behind a non-specular bounce of a path that is regularized.
    *
    * Source: Kaplanyan and Dachsbacher, "Path Space Regularization for Holistic and Robust Light
    * Transport", Eurographics 2013; PBRT 4th ed., §13.4.1.
    */
  def regularized: Bsdf = this

  /** Does it scatter wavelengths differently? */
  def isDispersive: Boolean = false

  /** How it scatters one wavelength, in nm. Without asking for one, a dispersive BSDF has the index
    * of refraction of some typical wavelength.
    */
  def atWavelength(nm: Float): Bsdf = this

/** Scatters as `inner` does but for what a subclass overrides; one that changes what is scattered
  * must change it in the regularized BSDF and at each wavelength, too.
  */
abstract class WrappedBsdf(inner: Bsdf) extends Bsdf:
  def f(wo: Vec3, wi: Vec3): Rgb = inner.f(wo, wi)
  def pdf(wo: Vec3, wi: Vec3): Float = inner.pdf(wo, wi)
  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    inner.sample(wo, choice, u1, u2)
  def isSpecular: Boolean = inner.isSpecular
  def isTransmissive: Boolean = inner.isTransmissive
  override def regularized: Bsdf
  override def isDispersive: Boolean = inner.isDispersive
  override def atWavelength(nm: Float): Bsdf

/** @param weight     f·|cos θi|/pdf
  * @param pdf        per solid angle; for a specular direction the probability of its choice
  * @param eta        for transmission the index of refraction on the side of `wi` over that of
  *                   `wo`, else 1
  */
final class BsdfSample(
    val wi: Vec3,
    val weight: Rgb,
    val pdf: Float,
    val isSpecular: Boolean,
    val eta: Float = 1f
)

object BsdfSample:
  /** No direction: the path ends here. */
  val Absorbed: BsdfSample = BsdfSample(Vec3.Z, Rgb.Black, 0f, isSpecular = false)

/** A [[BsdfSample]] in storage that is overwritten by the next one, so that a path allocates
  * nothing. One per worker.
  */
final class Bounce:
  private val ownWi = MutableVec3(0f, 0f, 1f)
  private val ownWeight = MutableRgb()
  private var ownPdf = 0f
  private var ownIsSpecular = false
  private var ownEta = 1f

  def wi: MutableVec3 = ownWi

  /** f·|cos θi|/pdf; black: the path ends here. */
  def weight: Rgb = ownWeight.toRgb

  /** Per solid angle; for a specular direction the probability of its choice. */
  def pdf: Float = ownPdf
  def isSpecular: Boolean = ownIsSpecular

  /** For transmission the index of refraction on the side of `wi` over that of `wo`, else 1. */
  def eta: Float = ownEta

  def set(wi: Vec3, weight: Rgb, pdf: Float, isSpecular: Boolean, eta: Float = 1f): Unit =
    ownWi.set(wi)
    ownWeight.set(weight)
    ownPdf = pdf
    ownIsSpecular = isSpecular
    ownEta = eta

  /** Nothing is scattered. */
  def absorb(): Unit = set(Vec3.Z, Rgb.Black, 0f, isSpecular = false)

  def take(s: BsdfSample): Unit = set(s.wi, s.weight, s.pdf, s.isSpecular, s.eta)

  def toSample: BsdfSample = BsdfSample(wi.toVec3, weight, pdf, isSpecular, eta)

/** A BSDF that draws its directions without garbage: what most surfaces are made of. */
abstract class LeanBsdf extends Bsdf:
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit

  final def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val out = Bounce()
    draw(wo, choice, u1, u2, out)
    out.toSample
