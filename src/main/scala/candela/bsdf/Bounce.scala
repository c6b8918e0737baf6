package candela.bsdf

import candela.color.{MutableRgb, Rgb}
import candela.math.*

/** A [[BsdfSample]] in storage that is overwritten by the next one, so that a path allocates
  * nothing. One per worker.
  */
final class Bounce:
  private val ownWi = MutableVec3(0f, 0f, 1f)
  private val ownWeight = MutableRgb()
  private var ownPdf = 0f
  private var ownIsSpecular = false
  private var ownEta = 1f

  def wi: Vec3 = ownWi.toVec3

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

  def toSample: BsdfSample = BsdfSample(wi, weight, pdf, isSpecular, eta)

/** A BSDF that draws its directions without garbage: what most surfaces are made of. */
abstract class LeanBsdf extends Bsdf:
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit

  final def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val out = Bounce()
    draw(wo, choice, u1, u2, out)
    out.toSample
