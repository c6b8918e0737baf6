package candela.bsdf.composite

import candela.bsdf.{Bsdf, BsdfFlags, BsdfSample, Fresnel, Hemisphere, Material}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Varying}

/** The BSDF of a hair fibre at one offset across its width. Its lobes: surface reflection (R),
  * transmission (TT), transmission with one internal reflection (TRT), and all higher orders.
  *
  * The local x axis is the direction of the fibre. Each lobe is a product of a longitudinal term
  * (Mp), an azimuthal term (Np), and an attenuation (Ap).
  *
  * @param h      offset of the intersection across the width, −1 to 1
  * @param gammaO angle between the outgoing direction and the normal, whose sine is `h`
  * @param eta    index of refraction of the hair
  * @param sigmaA absorption coefficient inside, per unit of the hair's radius; ≥ 0
  * @param shape  roughnesses and scale tilt
  *
  * Sources: Marschner et al., "Light Scattering from Human Hair Fibers", SIGGRAPH 2003; d'Eon et
  * al., "An Energy-Conserving Hair Reflectance Model", EGSR 2011; Chiang et al., "A Practical and
  * Controllable Hair and Fur Model for Production Path Tracing", EG 2016.
  */
final class Hair private[composite] (
    h: Float,
    gammaO: Float,
    eta: Float,
    sigmaA: Rgb,
    shape: HairShape
) extends Bsdf:
  import Hair.*

  /** Sine and cosine of the longitudinal angle, rotated by the scale tilt for lobe `p`. */
  private def tiltedSin(sinO: Float, cosO: Float, p: Int): Float = p match
    case 0 => sinO * shape.cosTilt(1) - cosO * shape.sinTilt(1)
    case 1 => sinO * shape.cosTilt(0) + cosO * shape.sinTilt(0)
    case 2 => sinO * shape.cosTilt(2) + cosO * shape.sinTilt(2)
    case _ => sinO

  private def tiltedCos(sinO: Float, cosO: Float, p: Int): Float = Math.abs(p match
    case 0 => cosO * shape.cosTilt(1) + sinO * shape.sinTilt(1)
    case 1 => cosO * shape.cosTilt(0) - sinO * shape.sinTilt(0)
    case 2 => cosO * shape.cosTilt(2) - sinO * shape.sinTilt(2)
    case _ => cosO)

  /** Azimuthal angle of the refracted ray. */
  private def gammaT(sinO: Float, cosO: Float): Float =
    val etaP = safeSqrt(eta * eta - sinO * sinO) / Math.max(cosO, 1e-7f)
    // A ray along a fibre of index 1 is not refracted, and both may be 0
    val sine = if Math.abs(h) < etaP then h / etaP else Math.signum(h)
    Math.asin(sine.toDouble).toFloat

  /** Transmittance of one passage through the fibre. */
  private def transmitted(sinO: Float, gammaT: Float): Rgb =
    val cosT = safeSqrt(1f - square(sinO / eta))
    val pathLength = 2f * Math.max(0f, cos(gammaT)) / Math.max(cosT, 1e-7f)
    sigmaA.map(s => exp(-s * pathLength))

  /** The attenuation Ap of lobe `p`; `fresnel` is the reflectance of the outside. */
  private def share(p: Int, fresnel: Float, t: Rgb): Rgb = p match
    case 0 => Rgb.gray(fresnel)
    case 1 => t * square(1f - fresnel)
    case 2 => t * t * (square(1f - fresnel) * fresnel)
    case _ =>
      val scale = square(1f - fresnel) * square(fresnel)
      t.map(x => scale * x * x * x / Math.max(1f - x * fresnel, 1e-7f))

  private def fresnel(cosO: Float): Float =
    Fresnel.dielectric(cosO * safeSqrt(1f - h * h), eta)

  private def azimuthalTerm(p: Int, phi: Float, gammaT: Float): Float =
    if p == Lobes - 1 then 1f / TwoPi
    else
      val offset = wrapped(phi - exit(p, gammaO, gammaT))
      Logistic.density(offset, shape.azimuthal)

  /** Visits the lobes with their attenuation, longitudinal and azimuthal terms. */
  private inline def lobes(wo: Vec3, wi: Vec3)(inline visit: (Rgb, Float, Float) => Unit): Unit =
    val sinO = wo.x
    val sinI = wi.x
    val cosO = safeSqrt(1f - sinO * sinO)
    val cosI = safeSqrt(1f - sinI * sinI)
    val inside = gammaT(sinO, cosO)
    val phi = azimuth(wi) - azimuth(wo)
    val r = fresnel(cosO)
    val t = transmitted(sinO, inside)
    var p = 0
    while p < Lobes do
      val along =
        longitudinal(cosI, tiltedCos(sinO, cosO, p), sinI, tiltedSin(sinO, cosO, p), shape.v(p))
      visit(share(p, r, t), along, azimuthalTerm(p, phi, inside))
      p += 1

  def f(wo: Vec3, wi: Vec3): Rgb =
    val cosine = Math.abs(wi.z)
    var sum = Rgb.Black
    lobes(wo, wi)((share, along, around) => sum += share * (along * around))
    if cosine > Hemisphere.Horizon then sum * (1f / cosine) else Rgb.Black

  def pdf(wo: Vec3, wi: Vec3): Float =
    var sum = 0f
    var total = 0f
    lobes(wo, wi): (share, along, around) =>
      val weight = share.average
      sum += weight * along * around
      total += weight
    if total > 0f then sum / total else 0f

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val sinO = wo.x
    val cosO = safeSqrt(1f - sinO * sinO)
    val inside = gammaT(sinO, cosO)
    val r = fresnel(cosO)
    val t = transmitted(sinO, inside)
    var total = 0f
    var p = 0
    while p < Lobes do
      total += share(p, r, t).average
      p += 1
    // Select a lobe by its attenuation, and remap the sample
    p = 0
    var remaining = choice * total
    var lobeWeight = share(0, r, t).average
    while p < Lobes - 1 && remaining >= lobeWeight do
      remaining -= lobeWeight
      p += 1
      lobeWeight = share(p, r, t).average
    val remapped =
      if lobeWeight > 0f then clamp(remaining / lobeWeight, 0f, OneMinusEpsilon) else 0f
    val sinP = tiltedSin(sinO, cosO, p)
    val cosP = tiltedCos(sinO, cosO, p)
    val v = shape.v(p)
    val height = 1f + v * log(Math.max(u1, 1e-5f) + (1f - u1) * exp(-2f / v))
    val sinI = clamp(
      -height * sinP + safeSqrt(1f - height * height) * cos(TwoPi * u2) * cosP,
      -1f,
      1f
    )
    val cosI = safeSqrt(1f - sinI * sinI)
    val turn =
      if p == Lobes - 1 then TwoPi * remapped
      else exit(p, gammaO, inside) + Logistic.sample(remapped, shape.azimuthal)
    val phi = azimuth(wo) + turn
    val wi = Vec3(sinI, cosI * cos(phi), cosI * sin(phi))
    val density = pdf(wo, wi)
    if !(density > 0f) || Math.abs(wi.z) < Hemisphere.Horizon then BsdfSample.Absorbed
    else
      val weight = f(wo, wi) * (Math.abs(wi.z) / density)
      if weight.isFinite then BsdfSample(wi, weight, density, isSpecular = false)
      else BsdfSample.Absorbed

  def flags: BsdfFlags = Hair.Flags

object Hair:
  /** Of a hair that is hit from outside. */
  def apply(h: Float, eta: Float, sigmaA: Rgb, shape: HairShape): Hair =
    new Hair(h, Math.asin(clamp(h, -1f, 1f).toDouble).toFloat, eta, sigmaA, shape)

  private[composite] val Flags: BsdfFlags =
    BsdfFlags.Glossy | BsdfFlags.Transmissive | BsdfFlags.NonReciprocal | BsdfFlags.Choosing

  /** R, TT, TRT, and one lobe for the rest. */
  private inline val Lobes = 4

  private def azimuth(w: Vec3): Float = Math.atan2(w.z.toDouble, w.y.toDouble).toFloat

  /** Azimuthal deflection of lobe `p`. */
  private def exit(p: Int, gammaO: Float, gammaT: Float): Float =
    2f * p.toFloat * gammaT - 2f * gammaO + p.toFloat * Pi

  private def wrapped(angle: Float): Float =
    angle - TwoPi * Math.round(angle / TwoPi).toFloat

  /** The longitudinal term for the variance `v` (d'Eon et al. 2011, eq. 7). Computed in Double: the
    * exponentials of a narrow lobe overflow Floats.
    */
  private def longitudinal(cosI: Float, cosO: Float, sinI: Float, sinO: Float, v: Float): Float =
    val a = cosI.toDouble * cosO / v
    val b = sinI.toDouble * sinO / v
    // I0(a) e^{−b} / (2v sinh(1/v)), with e^{1/v} factored out of both
    val scale = 1.0 / (v * -Math.expm1(-2.0 / v))
    (Bessel.scaledI0(a) * Math.exp(a - b - 1.0 / v) * scale).toFloat

/** [[Hair]] on a surface that is round, as in Mitsuba: the offset is that of the direction across
  * the normal. The local y axis is the direction of the fibre.
  */
final class RoundHair(eta: Float, sigmaA: Rgb, shape: HairShape) extends Bsdf:
  private def hair(wo: Vec3): Hair =
    val gammaO = -Math.atan2(wo.x.toDouble, wo.z.toDouble).toFloat
    new Hair(sin(gammaO), gammaO, eta, sigmaA, shape)

  private def turned(w: Vec3): Vec3 = Vec3(w.y, w.x, w.z)

  def f(wo: Vec3, wi: Vec3): Rgb = hair(wo).f(turned(wo), turned(wi))
  def pdf(wo: Vec3, wi: Vec3): Float = hair(wo).pdf(turned(wo), turned(wi))
  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val s = hair(wo).sample(turned(wo), choice, u1, u2)
    if s eq BsdfSample.Absorbed then s
    else BsdfSample(turned(s.wi), s.weight, s.pdf, s.isSpecular, s.eta)
  def flags: BsdfFlags = Hair.Flags

/** Roughness and scale tilt of a hair. Precomputed where they are constant.
  *
  * @param betaM longitudinal roughness, 0 to 1
  * @param betaN azimuthal roughness, 0 to 1
  * @param alpha tilt of the scales, degrees
  *
  * Source of the fits: Chiang et al. 2016.
  */
final class HairShape(betaM: Float, betaN: Float, alpha: Float):
  private val variances =
    val m = clamp(betaM, 1e-2f, 1f).toDouble
    val first = square((0.726 * m + 0.812 * m * m + 3.7 * Math.pow(m, 20)).toFloat)
    Array(first, 0.25f * first, 4f * first, 4f * first)

  /** Longitudinal variance of lobe `p`. */
  def v(p: Int): Float = variances(p)

  /** Scale of the azimuthal logistic distribution. */
  val azimuthal: Float =
    val n = clamp(betaN, 1e-2f, 1f).toDouble
    (Math.sqrt(Math.PI / 8) * (0.265 * n + 1.194 * n * n + 5.372 * Math.pow(n, 22))).toFloat

  // For 2^k times the tilt
  private val tilts = Array.tabulate(3)(k => Math.toRadians(alpha.toDouble) * (1 << k))
  private val sines = tilts.map(a => Math.sin(a).toFloat)
  private val cosines = tilts.map(a => Math.cos(a).toFloat)
  def sinTilt(k: Int): Float = sines(k)
  def cosTilt(k: Int): Float = cosines(k)

/** The logistic distribution truncated to [−π, π]. */
private[bsdf] object Logistic:
  private def cdf(x: Double, s: Float): Double = 1 / (1 + Math.exp(-x / s))

  def density(x: Float, s: Float): Float =
    val e = Math.exp(-Math.abs(x).toDouble / s)
    (e / (s * (1 + e) * (1 + e)) / (cdf(Math.PI, s) - cdf(-Math.PI, s))).toFloat

  def sample(u: Float, s: Float): Float =
    val low = cdf(-Math.PI, s)
    val y = low + u * (cdf(Math.PI, s) - low)
    val x = -s * Math.log(1 / y - 1)
    Math.max(-Math.PI, Math.min(Math.PI, x)).toFloat

/** The modified Bessel function of the first kind, order 0. */
private[bsdf] object Bessel:
  /** e^{−x} I0(x), x ≥ 0, to 2e-7. Source: Abramowitz and Stegun, "Handbook of Mathematical
    * Functions", 1964, 9.8.1 and 9.8.2.
    */
  def scaledI0(x: Double): Double =
    if x < 3.75 then
      val t = (x / 3.75) * (x / 3.75)
      val i0 = 1.0 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 +
        t * (0.2659732 + t * (0.0360768 + t * 0.0045813)))))
      i0 * Math.exp(-x)
    else
      val t = 3.75 / x
      val p = 0.39894228 + t * (0.01328592 + t * (0.00225319 + t * (-0.00157565 + t *
        (0.00916281 + t * (-0.02057706 + t * (0.02635537 + t * (-0.01647633 + t * 0.00392377)))))))
      p / Math.sqrt(x)

/** Source of a hair's absorption. */
enum Pigment extends Varying:
  /** Absorption coefficient, per unit of the hair's radius. */
  case Absorption(sigmaA: RgbTexture)

  /** Multiple-scattering colour of a volume of such hair. */
  case Color(reflectance: RgbTexture)

  /** Concentrations of the pigments eumelanin (black and brown) and pheomelanin (red); `convert`
    * brings colours to the scene's basis.
    */
  case Melanin(eumelanin: FloatTexture, pheomelanin: FloatTexture, convert: Rgb => Rgb)

  def absorption(at: ShadingPoint, betaN: Float): Rgb = this match
    case Absorption(sigmaA) => sigmaA.positive(at)
    case Color(reflectance) => Pigment.ofColor(reflectance(at), betaN)
    case Melanin(eu, pheo, convert) =>
      val e = Math.max(eu(at), 0f)
      val p = Math.max(pheo(at), 0f)
      convert(Pigment.Eumelanin * e + Pigment.Pheomelanin * p).map(s => Math.max(s, 0f))

  def isConstant: Boolean = this match
    case Absorption(t) => t.isConstant
    case Color(t) => t.isConstant
    case Melanin(e, p, _) => e.isConstant && p.isConstant

object Pigment:
  // Absorption of a unit concentration; source: d'Eon et al., EGSR 2011, as given in PBRT
  private val Eumelanin = Rgb(0.419f, 0.697f, 1.37f)
  private val Pheomelanin = Rgb(0.187f, 0.4f, 1.05f)

  /** Absorption of hair with the apparent `color` and azimuthal roughness `n` (Chiang et al. 2016,
    * §4.2).
    */
  private[bsdf] def ofColor(color: Rgb, n: Float): Rgb =
    val fit = 5.969f + n * (-0.215f + n * (2.532f + n * (-10.73f + n * (5.574f + n * 0.245f))))
    color.map(c => square(log(Math.max(c, 1e-4f)) / fit))

/** Where the offset across a hair comes from. */
enum HairOffset:
  /** From v of a curve. pbrt's highlights are on the side of the curve that is away from the light.
    */
  case Across

  /** As [[Across]], with the highlights on the side of the light. */
  case Mirrored

  /** From the normal, on any shape: [[RoundHair]]. */
  case Round

/** [[Hair]] on a curve, or on another shape. */
final class HairMaterial(
    offset: HairOffset,
    pigment: Pigment,
    eta: FloatTexture,
    betaM: FloatTexture,
    betaN: FloatTexture,
    alpha: FloatTexture
) extends Material:
  private val fixedShape =
    for m <- betaM.constant; n <- betaN.constant; a <- alpha.constant yield HairShape(m, n, a)
  private val fixedAbsorption =
    for n <- betaN.constant if pigment.isConstant yield pigment.absorption(ShadingPoint(), n)

  def bsdf(at: ShadingPoint): Bsdf =
    val shape = fixedShape match
      case Some(s) => s
      case None => HairShape(betaM(at), betaN(at), alpha(at))
    val sigmaA = fixedAbsorption match
      case Some(s) => s
      case None => pigment.absorption(at, betaN(at))
    val h = clamp(2f * at.v - 1f, -1f, 1f)
    offset match
      case HairOffset.Across => Hair(h, eta(at), sigmaA, shape)
      case HairOffset.Mirrored => Hair(-h, eta(at), sigmaA, shape)
      case HairOffset.Round => RoundHair(eta(at), sigmaA, shape)

  override def isAnisotropic: Boolean = true
  override def isDirected: Boolean = true
