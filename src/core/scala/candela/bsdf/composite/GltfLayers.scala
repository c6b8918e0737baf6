package candela.bsdf.composite

import candela.bsdf.{Bsdf, BsdfSample, CosineSampled, Hemisphere, WrappedBsdf}
import candela.color.Rgb
import candela.math.*

/** `inner`, of which layers above let through a part. */
abstract class Dimmed(inner: Bsdf) extends WrappedBsdf(inner):
  protected def passed(wo: Vec3, wi: Vec3): Float

  override def f(wo: Vec3, wi: Vec3): Rgb = inner.f(wo, wi) * passed(wo, wi)

  override protected def changed(wo: Vec3, s: BsdfSample): BsdfSample =
    BsdfSample(s.wi, s.weight * passed(wo, s.wi), s.pdf, s.isSpecular, s.eta)

  override def diffuseReflectance(wo: Vec3): Rgb =
    inner.diffuseReflectance(wo) * passed(wo, Vec3.Z)

/** What is under fibres, by the share that these reflect from either direction, as in
  * KHR_materials_sheen.
  *
  * @param sheen the largest component of their colour
  */
private final class UnderFibres(inner: Bsdf, sheen: Float, roughness: Float) extends Dimmed(inner):
  protected def passed(wo: Vec3, wi: Vec3): Float =
    val maxAlbedo = Math.max(SheenAlbedo(wo.z, roughness), SheenAlbedo(wi.z, roughness))
    Math.max(0f, 1f - sheen * maxAlbedo)
  override def regularized: Bsdf = UnderFibres(inner.regularized, sheen, roughness)

/** Fibres that stand on a surface.
  *
  * Source: Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 course.
  *
  * @param alpha square of the roughness, above 0
  */
final class CharlieSheen(color: Rgb, alpha: Float) extends CosineSampled:
  protected def value(wo: Vec3, wi: Vec3): Rgb =
    val across = wo + wi
    if across.isZero then Rgb.Black
    else color * CharlieSheen.value(Math.abs(wo.z), Math.abs(wi.z), across.normalized.z, alpha)

private object CharlieSheen:
  /** By the cosines of both directions and of their half vector. */
  def value(o: Float, i: Float, h: Float, alpha: Float): Float =
    val sine2 = Math.max(0f, 1f - h * h)
    val inverse = 1f / alpha
    val density = (2f + inverse) * Math.pow(sine2, 0.5 * inverse).toFloat / TwoPi
    val cosines = Math.max(4f * o * i, Hemisphere.Horizon)
    density / ((1f + lambda(o, alpha) + lambda(i, alpha)) * cosines)

  private def lambda(cosine: Float, alpha: Float): Float =
    val fit = Fit(square(1f - alpha))
    if cosine < 0.5f then exp(fit(cosine)) else exp(2f * fit(0.5f) - fit(1f - cosine))

  /** The fit of the source, between its two columns. */
  private final class Fit(t: Float):
    private val a = lerp(t, 21.5473f, 25.3245f)
    private val b = lerp(t, 3.82987f, 3.32435f)
    private val c = lerp(t, 0.19823f, 0.16801f)
    private val d = lerp(t, -1.97760f, -1.27393f)
    private val e = lerp(t, -4.32054f, -4.85967f)
    def apply(x: Float): Float = a / (1f + b * Math.pow(x, c).toFloat) + d * x + e

/** The share of light that white fibres reflect, by the cosine of its direction. */
private[composite] object SheenAlbedo:
  private inline val Cosines = 32
  private inline val Roughnesses = 16
  private inline val Steps = 48

  private lazy val table: Array[Float] = Array.tabulate(Roughnesses * Cosines): k =>
    val roughness = (k / Cosines + 1f) / Roughnesses
    albedo((k % Cosines + 0.5f) / Cosines, square(roughness))

  /** Midpoints in cosine and azimuth. */
  private def albedo(cosine: Float, alpha: Float): Float =
    val wo = Vec3(sqrt(1f - cosine * cosine), 0f, cosine)
    var sum = 0.0
    for j <- 0 until Steps; k <- 0 until Steps do
      val i = (j + 0.5f) / Steps
      val (sine, azimuth) = (sqrt(1f - i * i), Pi * (k + 0.5f) / Steps)
      val h = (wo + Vec3(sine * cos(azimuth), sine * sin(azimuth), i)).normalized
      sum += i * CharlieSheen.value(cosine, i, h.z, alpha)
    Math.min(1f, (sum * 2 * Math.PI / (Steps * Steps)).toFloat)

  def apply(cosine: Float, roughness: Float): Float =
    val x = clamp(Math.abs(cosine) * Cosines - 0.5f, 0f, Cosines - 1.001f)
    val y = clamp(roughness * Roughnesses - 1f, 0f, Roughnesses - 1.001f)
    val (i, j) = (x.toInt, y.toInt)
    def row(j: Int) = lerp(x - i, table(j * Cosines + i), table(j * Cosines + i + 1))
    lerp(y - j, row(j), row(j + 1))
