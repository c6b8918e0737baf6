package candela.scene

import candela.color.Rgb
import candela.geometry.{Ball, ShadingPoint}
import candela.lights.*
import candela.math.Vec3

/** Decorates lights to report their queries to a [[PathReport]]; otherwise unchanged. */
private[scene] object ReportedLights:
  def of(light: Light, index: Int, report: PathReport): Light = light match
    case l: SurfaceLight => OnSurface(l, index, report)
    case l: EnvironmentLight => Around(l, index, report)
    case l => Other(l, index, report)

  /** Light subpaths are not reported. */
  private sealed trait Emitting(source: Light) extends Light:
    override def isContrary: Boolean = source.isContrary
    override def power(scene: Ball): Float = source.power(scene)
    override def emit(
        scene: Ball,
        u1: Float,
        u2: Float,
        v1: Float,
        v2: Float,
        out: EmittedRay
    ): Unit = source.emit(scene, u1, u2, v1, v2, out)
    override def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
      source.emissionPdf(scene, p, n, w)
    override def connectionPdf(from: Vec3, ray: EmittedRay): Float = source.connectionPdf(from, ray)

  private final class Other(light: Light, index: Int, report: PathReport)
      extends Light
      with Emitting(light):
    def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
      light.sample(from, u1, u2, out)
      report.chosen(index, out)
    override def isSampled: Boolean = light.isSampled
    def isDelta: Boolean = light.isDelta
    def bounds: Option[LightBounds] = light.bounds

  private final class OnSurface(light: SurfaceLight, index: Int, report: PathReport)
      extends SurfaceLight
      with Emitting(light):
    def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
      light.sample(from, u1, u2, out)
      report.chosen(index, out)
    override def isSampled: Boolean = light.isSampled
    override def isShownOnly: Boolean = light.isShownOnly
    def bounds: Option[LightBounds] = light.bounds
    def radiance(at: ShadingPoint, w: Vec3): Rgb =
      val emitted = light.radiance(at, w)
      report.found(index, emitted)
      emitted
    def pdf(from: Vec3, at: ShadingPoint): Float = light.pdf(from, at)

  private final class Around(light: EnvironmentLight, index: Int, report: PathReport)
      extends EnvironmentLight
      with Emitting(light):
    protected def total: Float = 0f // unused: `power` delegates
    def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
      light.sample(from, u1, u2, out)
      report.chosen(index, out)
    override def isSampled: Boolean = light.isSampled
    def radiance(from: Vec3, d: Vec3): Rgb =
      val emitted = light.radiance(from, d)
      report.found(index, emitted)
      emitted
    def pdf(from: Vec3, d: Vec3): Float = light.pdf(from, d)
