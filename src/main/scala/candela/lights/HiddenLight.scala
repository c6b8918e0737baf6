package candela.lights

import candela.geometry.Ball
import candela.math.Vec3

/** A surface that lights the scene and is nowhere to be seen: pbrt-v4's emitters whose `alpha` is
  * 0. No ray meets it, so that only [[sample]] finds it.
  */
final class HiddenLight(light: SurfaceLight) extends Light:
  def isDelta: Boolean = true
  override def isContrary: Boolean = light.isContrary
  def bounds: Option[LightBounds] = light.bounds
  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    light.sample(from, u1, u2, out)
  def power(scene: Ball): Float = light.power(scene)
  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit =
    light.emit(scene, u1, u2, v1, v2, out)
  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    light.emissionPdf(scene, p, n, w)
  def meetingPdf(from: Vec3, ray: EmittedRay): Float = light.meetingPdf(from, ray)
