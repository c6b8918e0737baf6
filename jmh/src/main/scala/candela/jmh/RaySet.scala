package candela.jmh

import java.util.SplittableRandom

import candela.accel.Accelerator
import candela.geometry.{Frame, Hit, Ray}
import candela.math.*
import candela.shapes.TriangleSoup

/** Rays in a flat array: origin, direction and end, seven Floats each.
  *
  * @param anyHit do they only ask whether something is in the way?
  */
final class RaySet(val name: String, val anyHit: Boolean, val floats: Array[Float]):
  def count: Int = floats.length / 7

/** What an accelerator answers to a set of rays. */
final class RayPass(a: Accelerator, set: RaySet):
  private val ray = Ray()
  private val hit = Hit()
  var hits = 0

  /** Of the distances to what was met. */
  var sum = 0.0

  def clear(): Unit =
    hits = 0
    sum = 0.0

  /** Asks for the rays first ≤ i < end. */
  def run(first: Int, end: Int): Unit =
    val f = set.floats
    var i = 7 * first
    while i < 7 * end do
      ray.set(f(i), f(i + 1), f(i + 2), f(i + 3), f(i + 4), f(i + 5), f(i + 6))
      if set.anyHit then
        if a.isOccluded(ray, hit) then hits += 1
      else if a.closest(ray, hit) then
        hits += 1
        sum += ray.tMax
      i += 7

object RaySet:
  /** What a path tracer asks for: rays of a pinhole camera row by row, a diffuse bounce of each
    * that hits, and its shadow ray to an emitter of some size.
    */
  def all(soup: TriangleSoup, world: Accelerator, side: Int): Seq[RaySet] =
    val random = SplittableRandom(9)
    def draw() = random.nextDouble().toFloat
    val camera, bounce, shadow = Array.newBuilder[Float]
    val eye = Vec3(-6f, -7f, 5f)
    val view = Frame.fromZ((Vec3(0f, 0f, 0.8f) - eye).normalized)
    val (ray, hit) = (Ray(), Hit())
    def put(to: scala.collection.mutable.ArrayBuilder[Float], o: Vec3, d: Vec3, end: Float) =
      to ++= Array(o.x, o.y, o.z, d.x, d.y, d.z, end)
    for y <- 0 until side; x <- 0 until side do
      val (sx, sy) = ((x + draw()) / side - 0.5f, (y + draw()) / side - 0.5f)
      val d = view.toWorld(Vec3(0.9f * sx, 0.9f * sy, 1f)).normalized
      put(camera, eye, d, Float.PositiveInfinity)
      ray.set(eye, d, Float.PositiveInfinity)
      if world.closest(ray, hit) then
        val i = hit.primitive
        val (a, b, c) = (soup.vertex(i, 0), soup.vertex(i, 1), soup.vertex(i, 2))
        val facet = (b - a) cross (c - a)
        if facet.lengthSquared > 0f then
          val n = facet.normalized.facing(-d)
          val o = ray.at(ray.tMax) + n * 1e-4f
          val (r, phi) = (sqrt(draw()), TwoPi * draw())
          val out = Vec3(r * cos(phi), r * sin(phi), sqrt(1f - r * r))
          put(bounce, o, Frame.fromZ(n).toWorld(out), Float.PositiveInfinity)
          val emitter = Vec3(2f + draw(), -3f + draw(), 6f)
          put(shadow, o, (emitter - o).normalized, (emitter - o).length)
    Seq(
      RaySet("camera", false, camera.result()),
      RaySet("bounce", false, bounce.result()),
      RaySet("shadow", true, shadow.result())
    )
