package candela.shapes

import org.scalatest.Assertions.assert

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*

/** Partial derivatives against finite differences. */
object PartialsLaws:

  /** What a ray finds, if anything. */
  private def find(shape: Shape, o: Vec3, d: Vec3): Option[ShadingPoint] =
    val (ray, hit) = (Ray(), Hit())
    ray.set(o, d, Float.PositiveInfinity)
    Option.when(shape.intersect(ray, hit)):
      val at = ShadingPoint(wantsPartials = true)
      shape.surface(ray, hit, at)
      at

  /** Moves a ray sideways by `step` and compares where it arrives with what the derivatives of the
    * middle of the two hits say of a change of u and v like that.
    *
    * @param size of the shape: hits are compared to 3 % or 1e-5 of this
    * @return was there anything to compare? Not at edges and seams, nor seen at a grazing angle,
    *         from where a small step is a long way on the surface
    */
  def check(shape: Shape, o: Vec3, d: Vec3, side: Vec3, step: Float, size: Float): Boolean =
    val found =
      for
        a <- find(shape, o - side * step, d)
        m <- find(shape, o, d)
        b <- find(shape, o + side * step, d)
        (du, dv) = (b.u - a.u, b.v - a.v)
        if (b.p - a.p).length < 6 * step && Math.abs(du) < 0.1f && Math.abs(dv) < 0.1f
      yield
        val moved = (b.p - a.p) - (m.dpdu * du + m.dpdv * dv)
        val bound = 0.03f * (b.p - a.p).length + 1e-5f * size
        assert(moved.length < bound, s"p at ${m.p}: ${moved.length} of $bound")
        val turned = (b.frame.n - a.frame.n) - (m.dndu * du + m.dndv * dv)
        val most = 0.03f * (b.frame.n - a.frame.n).length + 2e-5f
        assert(turned.length < most, s"n at ${m.p}: ${turned.length} of $most")
    found.isDefined
