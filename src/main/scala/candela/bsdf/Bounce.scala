package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** What a [[BsdfSample]] says, to be written over by the next: it owns its vectors, so that a path
  * leaves no garbage. Mutable, one per worker.
  */
final class Bounce:
  private val ownWi = Vec3.Z.copy
  private val ownWeight = Rgb.Black.copy
  private var ownPdf = 0f
  private var ownIsSpecular = false
  private var ownEta = 1f

  def wi: Vec3 = ownWi

  /** f·|cos θi|/pdf; black: the path ends here. */
  def weight: Rgb = ownWeight

  /** Per solid angle; for a specular direction the probability of its choice. */
  def pdf: Float = ownPdf
  def isSpecular: Boolean = ownIsSpecular

  /** For transmission the index of refraction on the side of `wi` over that of `wo`, else 1. */
  def eta: Float = ownEta

  def set(wi: Vec3, weight: Rgb, pdf: Float, isSpecular: Boolean, eta: Float = 1f): Unit =
    ownWi.become(wi)
    ownWeight.become(weight)
    ownPdf = pdf
    ownIsSpecular = isSpecular
    ownEta = eta

  /** Nothing is scattered. */
  def absorb(): Unit = set(Vec3.Z, Rgb.Black, 0f, isSpecular = false)

  def take(s: BsdfSample): Unit = set(s.wi, s.weight, s.pdf, s.isSpecular, s.eta)

  def toSample: BsdfSample = BsdfSample(wi.copy, weight.copy, pdf, isSpecular, eta)

/** A BSDF that draws its directions without garbage: what most surfaces are made of. */
abstract class LeanBsdf extends Bsdf:
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit

  final def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val out = Bounce()
    draw(wo, choice, u1, u2, out)
    out.toSample
