package candela.scene

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.lights.*
import candela.math.Vec3

/** Decorates lights to report their queries to a [[PathReport]]; otherwise unchanged. */
private[scene] object ReportedLights:
  def of(light: Light, index: Int, report: PathReport): Light =
    val (surface, environment) = (light.asSurface, light.asEnvironment)
    if surface != null then OnSurface(surface, index, report)
    else if environment != null then Around(environment, index, report)
    else Other(light, index, report)

  private final class Other(light: Light, index: Int, report: PathReport)
      extends Light
      with WrappedLight(light):
    def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
      light.sample(from, u1, u2, out)
      report.chosen(index, out)
    def isDelta: Boolean = light.isDelta
    def bounds: Option[LightBounds] = light.bounds

  private final class OnSurface(light: SurfaceLight, index: Int, report: PathReport)
      extends SurfaceLight
      with WrappedLight(light):
    def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
      light.sample(from, u1, u2, out)
      report.chosen(index, out)
    def bounds: Option[LightBounds] = light.bounds
    def radiance(at: ShadingPoint, w: Vec3): Rgb =
      val emitted = light.radiance(at, w)
      report.reportHit(index, emitted)
      emitted
    def pdf(from: Vec3, at: ShadingPoint): Float = light.pdf(from, at)

  private final class Around(light: EnvironmentLight, index: Int, report: PathReport)
      extends EnvironmentLight
      with WrappedLight(light):
    protected def total: Float = 0f // unused: `power` delegates
    def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
      light.sample(from, u1, u2, out)
      report.chosen(index, out)
    def radiance(from: Vec3, d: Vec3): Rgb =
      val emitted = light.radiance(from, d)
      report.reportHit(index, emitted)
      emitted
    def pdf(from: Vec3, d: Vec3): Float = light.pdf(from, d)
