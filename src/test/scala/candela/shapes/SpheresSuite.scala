package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.Draws

class SpheresSuite extends AnyFunSuite:

  /** All that rays and emitters ask of a sphere. */
  private def answers(s: Sphere, draws: Draws, around: Vec3): Vector[Any] =
    val (ray, hit, at, sample) = (Ray(), Hit(), ShadingPoint(wantsPartials = true), SurfaceSample())
    Vector(s.bounds, s.area, s.normals) ++ Vector.fill(5) {
      val from = around + draws.direction() * draws.between(0f, 9f)
      ray.set(from, around + draws.direction() * 0.9f - from, Float.PositiveInfinity)
      val isHit = s.isHit(ray)
      val found = s.intersectSurface(ray, hit, at)
      s.sample(from, draws.unit(), draws.unit(), sample)
      val chosen = Vector(vec(sample.p), vec(sample.n), vec(sample.pError), sample.pdf)
      s.sampleArea(draws.unit(), draws.unit(), sample)
      val ofArea = Vector(vec(sample.p), sample.pdf)
      val pdfs = Vector(s.pdf(from, sample.p, sample.n), s.areaPdf(sample.p))
      val seen =
        if found then Vector(vec(at.p), vec(at.pError), vec(at.dpdu), vec(at.dndv), at.u, at.v)
        else Vector.empty
      Vector(isHit, found, ray.tMax) ++ seen ++ chosen ++ ofArea ++ pdfs
    }.flatten

  private def vec(v: Vec3): (Float, Float, Float) = (v.x, v.y, v.z)

  test("spheres that share what they can answer as those that share nothing, to the bit"):
    val draws = Draws(3)
    val spheres = Spheres(1.5f, -1.2f, 1.5f, 5f)
    var hits = 0
    for turn <- 0 until 60 do
      val linear =
        if turn % 3 == 0 then Transform.scale(2, 2, 2).get
        else draws.rotation() * Transform.scale(1, draws.between(1f, 2f), 1).get
      for _ <- 0 until 4 do
        val place = draws.direction() * 20f
        val toWorld = Transform.translate(place.x, place.y, place.z) * linear
        val reversed = draws.coin()
        val alone = Sphere(toWorld, 1.5f, -1.2f, 1.5f, 5f, reversed)
        val seed = 100 + hits
        val found = answers(spheres(toWorld, reversed), Draws(seed), place)
        assert(found == answers(alone, Draws(seed), place))
        if found.contains(true) then hits += 1
    assert(hits > 200)

  test("a sphere shares with the one before what differs in its place alone"):
    def form(t: Transform) = SphereForm(t, 1f, -1f, 1f, TwoPi, false)
    val scale = Transform.scale(2, 3, 2).get
    val here = form(Transform.translate(1, 2, 3) * scale)
    assert(here.fits(Transform.translate(-4, 5, 0) * scale))
    assert(!here.fits(Transform.translate(1, 2, 3) * Transform.scale(2, 3, 2.5).get))
    assert(!here.fits(Transform.translate(1, 2, 3)))
