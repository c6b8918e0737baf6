package candela.geometry

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.Draws

class RayDifferentialSuite extends AnyFunSuite:

  /** A sphere of this radius around the origin, met from outside at `p`. */
  private def onSphere(p: Vec3): ShadingPoint =
    val at = ShadingPoint(wantsPartials = true)
    val n = p.normalized
    at.p = p
    at.geometricNormal = n
    at.frame.set(Frame.fromZ(n))
    // Parameters along the tangents, in units of length; the normal turns by 1/radius
    val turn = 1f / p.length
    at.setPartials(at.frame.s, at.frame.t, at.frame.s * turn, at.frame.t * turn)
    at

  /** Where a ray first meets the sphere of this radius, if it does. */
  private def meet(o: Vec3, d: Vec3, radius: Float): Option[Vec3] =
    val b = o dot d
    val c = o.lengthSquared - radius * radius
    val s = b * b - c
    Option.when(s > 0f)(o + d * (-b - sqrt(s)))

  private def reflected(d: Vec3, n: Vec3): Vec3 = d - n * (2f * (d dot n))

  private def refracted(d: Vec3, n: Vec3, eta: Float): Vec3 =
    val cosine = -(d dot n)
    val inside = sqrt(1f - (1f - cosine * cosine) / (eta * eta))
    d * (1f / eta) + n * (cosine / eta - inside)

  private def check(bend: (Vec3, Vec3) => Vec3)(
      follow: (RayDifferential, ShadingPoint, Vec3, Vec3) => Unit
  ): Unit =
    val draws = Draws(1)
    val (radius, h) = (2f, 2e-3f)
    var compared = 0
    for _ <- 0 until 2000 do
      val o = draws.direction() * 6f
      val d = (draws.direction() * 1.6f - o).normalized
      val (ox, dx) = (o + draws.direction() * h, (d + draws.direction() * h).normalized)
      for p <- meet(o, d, radius); q <- meet(ox, dx, radius) do
        // Not at grazing angles, where the differences are not small
        if -(d dot p) / radius > 0.5f then
          val at = onSphere(p)
          val rays = RayDifferential()
          rays.isKnown = true
          rays.xOrigin = ox
          rays.xDirection = dx
          rays.yOrigin = o + Vec3(h, 0, 0)
          rays.yDirection = d
          assert(rays.computeFootprint(at))
          at.footprintInUv()
          assert((at.dpdx - (q - p)).length < 0.02f * (q - p).length + 2e-5f)
          val wi = bend(d, at.frame.n)
          follow(rays, at, -d, wi)
          val expected = bend(dx, q.normalized)
          val change = (expected - wi).length
          assert((rays.xDirection - expected).length < 0.03f * change + 1e-5f)
          assert((rays.xOrigin - q).length < 2e-5f + 0.02f * (q - p).length)
          compared += 1
    assert(compared > 500): Unit

  test("behind a curved mirror, a differential is where the neighbouring ray goes"):
    check(reflected)((rays, at, wo, wi) => rays.reflect(at, wo, wi))

  test("behind curved glass, a differential is where the neighbouring ray goes"):
    check(refracted(_, _, 1.5f))((rays, at, wo, wi) => rays.refract(at, wo, wi, 1.5f))

  test("the footprint in u and v solves for the step in space"):
    val draws = Draws(2)
    for _ <- 0 until 500 do
      val at = ShadingPoint(wantsPartials = true)
      at.setPartials(draws.vec(-2, 2), draws.vec(-2, 2), Vec3.Zero, Vec3.Zero)
      val (a, b, c, d) = (draws.unit(), draws.unit(), draws.unit(), draws.unit())
      at.dpdx = at.dpdu * a + at.dpdv * b
      at.dpdy = at.dpdu * c + at.dpdv * d
      if (at.dpdu.normalized cross at.dpdv.normalized).length > 0.2f then
        at.footprintInUv()
        val found = Seq(at.dudx, at.dvdx, at.dudy, at.dvdy)
        // 6e-8 over the squared sine between the tangents, 0.04, times the ratio of their lengths
        assert(found.zip(Seq(a, b, c, d)).forall((x, y) => abs(x - y) < 1e-4f), s"$found"): Unit

  test("a ray along the surface has no footprint, and says so"):
    val rays = RayDifferential()
    val at = onSphere(Vec3(0, 0, 1))
    assert(!rays.computeFootprint(at))
    rays.isKnown = true
    rays.xOrigin = Vec3(0, 0, 2)
    rays.xDirection = Vec3.X
    rays.yOrigin = Vec3(0, 0, 2)
    rays.yDirection = Vec3(0, 0, -1)
    assert(!rays.computeFootprint(at))
    assert(at.dpdx.isZero && at.dpdy.isZero)
