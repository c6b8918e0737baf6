package candela.bsdf

import candela.color.{MutableRgb, Rgb}
import candela.math.*

import scala.annotation.unused

/** The BSDF at a surface point. Directions are unit vectors that point away from the surface, in a
  * local frame whose +z is the shading normal. `wo` is the direction towards the camera, `wi` the
  * direction towards the light. Immutable.
  */
abstract class Bsdf:

  /** The BSDF value in sr⁻¹, without the cosine; black for perfectly specular scattering. */
  def f(wo: Vec3, wi: Vec3): Rgb

  /** Reflection where the shading normal separates the directions, and the geometric one doesn't:
    * BRDFs of pbrt-v2 and v3 then look at no side.
    */
  def reflectedAcross(wo: Vec3, wi: Vec3): Rgb = f(wo, Hemisphere.flipped(wi))

  /** The pdf of `sample` with respect to solid angle; 0 for specular scattering. */
  def pdf(wo: Vec3, wi: Vec3): Float

  /** Samples `wi` given `wo`.
    *
    * @param choice selects the lobe, in [0, 1)
    * @return       [[BsdfSample.Absorbed]] if nothing is scattered
    */
  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample

  /** As [[sample]], written to `out`. */
  def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    out.copyFrom(sample(wo, choice, u1, u2))

  /** Samples perfectly specular directions only, for Whitted's recursion. */
  def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    if isSpecular then sample(wo, choice, 0.5f, 0.5f) else BsdfSample.Absorbed

  /** Fraction of the light that its diffuse part reflects; without such a part, π times its value
    * for light along the normal.
    *
    * Source: Mitsuba 3, `BSDF::eval_diffuse_reflectance`.
    */
  def diffuseReflectance(wo: Vec3): Rgb = f(wo, Vec3.Z) * Pi

  /** Properties for light transport. */
  def flags: BsdfFlags

  /** Whether all scattering is perfectly specular, so that light sampling can't contribute. */
  final def isSpecular: Boolean = !flags.hasAny(BsdfFlags.Diffuse | BsdfFlags.Glossy)
  final def isTransmissive: Boolean = flags.hasAny(BsdfFlags.Transmissive)

  /** Whether light is scattered to a range of directions on the other side. */
  def scattersThrough: Boolean = isTransmissive && !isSpecular
  final def isDiffuse: Boolean = flags.hasAny(BsdfFlags.Diffuse)
  final def isReciprocal: Boolean = !flags.hasAny(BsdfFlags.NonReciprocal)
  final def isDispersive: Boolean = flags.hasAny(BsdfFlags.Dispersive)
  final def choosesLobes: Boolean = flags.hasAny(BsdfFlags.Choosing)
  final def isPane: Boolean = flags.hasAny(BsdfFlags.Pane)
  final def isNarrow: Boolean = flags.hasAny(BsdfFlags.Narrow)

  /** Transmittance of a thin dielectric for light that keeps its direction. */
  def straight(@unused wo: Vec3): Rgb = Rgb.Black

  /** The BSDF with specular and narrow lobes roughened, so that next-event estimation can sample
    * them. Used at vertices after a non-specular bounce of a regularised path.
    *
    * Source: Kaplanyan and Dachsbacher, "Path Space Regularization for Holistic and Robust Light
    * Transport", Eurographics 2013; PBRT 4th ed., §13.4.1.
    */
  def regularized: Bsdf = this

/** Answers as `inner` does. A subclass overrides what it changes: the value, the density, the
  * samples of either kind in [[changed]].
  */
abstract class WrappedBsdf(inner: Bsdf) extends Bsdf:
  def f(wo: Vec3, wi: Vec3): Rgb = inner.f(wo, wi)
  def pdf(wo: Vec3, wi: Vec3): Float = inner.pdf(wo, wi)

  final def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    changed(wo, inner.sample(wo, choice, u1, u2))

  final override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    changed(wo, inner.sampleSpecular(wo, choice))

  /** Transforms a sample of `inner`. */
  protected def changed(@unused wo: Vec3, sample: BsdfSample): BsdfSample = sample

  def flags: BsdfFlags = inner.flags
  override def scattersThrough: Boolean = isTransmissive && inner.scattersThrough
  override def straight(wo: Vec3): Rgb = inner.straight(wo)
  override def regularized: Bsdf

/** @param weight f·|cos θi|/pdf
  * @param pdf    with respect to solid angle; for a specular direction the probability of its
  *               choice
  * @param eta    relative index of refraction for transmission: on the side of `wi` over that of
  *               `wo`; else 1
  */
final class BsdfSample(
    val wi: Vec3,
    val weight: Rgb,
    val pdf: Float,
    val isSpecular: Boolean,
    val eta: Float = 1f
)

object BsdfSample:
  /** No direction: the path ends. */
  val Absorbed: BsdfSample = BsdfSample(Vec3.Z, Rgb.Black, 0f, isSpecular = false)

/** A reusable, mutable [[BsdfSample]], so that paths allocate nothing. One per worker. */
final class Bounce:
  private val ownWi = MutableVec3(0f, 0f, 1f)
  private val ownWeight = MutableRgb()
  private var ownPdf = 0f
  private var ownIsSpecular = false
  private var ownEta = 1f

  def wi: MutableVec3 = ownWi

  /** f·|cos θi|/pdf; black ends the path. */
  def weight: MutableRgb = ownWeight

  /** With respect to solid angle; for a specular direction the probability of its choice. */
  def pdf: Float = ownPdf
  def isSpecular: Boolean = ownIsSpecular

  /** Relative index of refraction for transmission: on the side of `wi` over that of `wo`; else 1.
    */
  def eta: Float = ownEta

  def set(wi: Vec3, weight: Rgb, pdf: Float, isSpecular: Boolean, eta: Float = 1f): Unit =
    ownWi.set(wi)
    ownWeight.set(weight)
    ownPdf = pdf
    ownIsSpecular = isSpecular
    ownEta = eta

  /** Scales the weight. */
  def scale(s: Float): Unit = ownWeight.scale(s)

  /** Sets the absorbed sample. */
  def absorb(): Unit = set(Vec3.Z, Rgb.Black, 0f, isSpecular = false)

  def copyFrom(s: BsdfSample): Unit = set(s.wi, s.weight, s.pdf, s.isSpecular, s.eta)

  def toSample: BsdfSample = BsdfSample(wi.toVec3, weight.toRgb, pdf, isSpecular, eta)

/** Base of BSDFs that sample without allocation; covers most surfaces. */
abstract class LeanBsdf extends Bsdf:
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit

  final def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val bounce = Bounce()
    draw(wo, choice, u1, u2, bounce)
    bounce.toSample
