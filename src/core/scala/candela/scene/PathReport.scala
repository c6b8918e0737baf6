package candela.scene

import candela.bsdf.{Bsdf, BsdfSample, WrappedBsdf}
import candela.color.{Rgb, Wavelengths}
import candela.geometry.ShadingPoint
import candela.lights.LightSample
import candela.math.Vec3

/** Reports the events of one path in order, for debugging a bad sample. BSDF directions are in the
  * shading frame, everything else is in world space.
  *
  * @param say receives one line at a time
  */
final class PathReport(say: String => Unit):
  private var vertices = 0
  private var throughput = Rgb.White

  /** Reports what the three components of all following colours are. */
  def components(basis: Wavelengths): Unit =
    val nm = basis.nm.map(w => Math.round(w * 10) / 10f)
    say(s"colours are at ${nm(0)}, ${nm(1)} and ${nm(2)} nm: the first is the hero")

  /** Reports a scattering vertex; returns a BSDF that also reports its evaluations. */
  def scatters(at: ShadingPoint, bsdf: Bsdf): Bsdf =
    vertices += 1
    say(s"$vertices: point ${at.p} (error ${at.pError}), material ${at.material}: ${name(bsdf)}")
    say(s"   normal ${at.geometricNormal}, shading normal ${at.frame.n}; u ${at.u}, v ${at.v}")
    ReportedBsdf(bsdf, this)

  /** Reports light that a thin dielectric transmits to a vertex. */
  def passes(at: ShadingPoint, transmitted: Rgb): Unit =
    say(s"   thin dielectric at ${at.p} transmits $transmitted")

  def value(wo: Vec3, wi: Vec3, f: Rgb): Unit = say(s"   wo $wo, wi $wi: f $f")

  def density(pdf: Float): Unit = say(s"   pdf $pdf")

  /** Accumulates the throughput as the product of all weights: right for integrators that follow
    * every sample.
    */
  def bounce(wo: Vec3, s: BsdfSample): Unit =
    throughput = throughput * s.weight
    val kind = if s.isSpecular then "specular, " else ""
    say(s"   continues from wo $wo to wi ${s.wi}: ${kind}weight ${s.weight}, pdf ${s.pdf}, " +
      s"throughput $throughput")

  def chosen(light: Int, s: LightSample): Unit =
    say(
      s"   light $light is sampled: radiance ${s.radiance.toRgb}, pdf ${s.pdf}, direction ${s.wi}"
    )

  def reportHit(light: Int, radiance: Rgb): Unit =
    say(s"   light $light is hit: radiance $radiance, throughput $throughput")

  /** Reports the replacement of the BSDF at the current vertex. */
  def reportBsdf(bsdf: Bsdf, label: String): Bsdf =
    say(s"   $label: ${name(bsdf)}")
    ReportedBsdf(bsdf, this)

  private def name(bsdf: Bsdf): String = bsdf.getClass.getSimpleName

/** Reports every query and its result. */
private final class ReportedBsdf(bsdf: Bsdf, report: PathReport) extends WrappedBsdf(bsdf):
  override def f(wo: Vec3, wi: Vec3): Rgb =
    val value = bsdf.f(wo, wi)
    report.value(wo, wi, value)
    value

  override def pdf(wo: Vec3, wi: Vec3): Float =
    val density = bsdf.pdf(wo, wi)
    report.density(density)
    density

  override protected def changed(wo: Vec3, sample: BsdfSample): BsdfSample =
    report.bounce(wo, sample)
    sample

  override def regularized: Bsdf = report.reportBsdf(bsdf.regularized, "regularized")
