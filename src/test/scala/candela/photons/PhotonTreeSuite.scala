package candela.photons

import candela.concurrency.GivenUp
import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler
import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

final class PhotonTreeSuite extends AnyFunSuite:

  /** Some in each medium, some at surfaces, and some at the same place as others. */
  private def photons(draws: Draws, n: Int): Vector[(Vec3, Int, Int)] =
    Vector.tabulate(n): i =>
      val p = if i % 50 == 0 then Vec3(.1f, .2f, .3f) else draws.vec(-1, 1)
      (p, i % 4 - 1, 1 + i % 5)

  private def tree(all: Seq[(Vec3, Int, Int)], radius: Float): PhotonTree =
    val parts = all.grouped(70).toArray.map: part =>
      val photons = Photons()
      for (p, medium, edges) <- part do
        photons.add(p, Vec3.Z, Rgb.White, if edges == 2 then -edges else edges, medium)
      photons
    PhotonTree(parts, paths = 1, radius)

  for n <- Vector(0, 1, 7, 8, 9, 65, 3000) do
    test(s"a ray finds those of its medium within the radius, each once, in their order: of $n"):
      val draws = Draws(n + 1)
      val all = photons(draws, n)
      val radius = 0.2f
      val made = tree(all, radius)
      assert(made.count == all.count(_._2 >= 0))
      val passed = PassedPhotons()
      val ray = Ray()
      var found = 0
      for k <- 1 to 200 do
        val (origin, medium, most) = (draws.vec(-1.5f, 1.5f), k % 4, 1 + k % 5)
        val along = if k % 3 == 0 then Vec3.X else draws.direction() * (0.5f + draws.unit())
        val end = if k % 2 == 0 then Float.PositiveInfinity else 2 * draws.unit()
        ray.set(origin, along, end)
        made.query(ray, medium, most, passed)
        val expected = all.filter: (p, in, edges) =>
          val t = ((p - origin) dot along) / along.lengthSquared
          in == medium && edges <= most && t > 0 && t < end &&
          (p - origin - along * t).length < radius
        val ts = Vector.tabulate(passed.count)(passed.t)
        assert(ts.size == expected.size && ts == ts.sorted)
        val places = (0 until passed.count).map(i => made.data(passed.offset(i)))
        assert(places.toSet == expected.map(_._1.x).toSet)
        assert(Vector.tabulate(passed.count)(passed.offset).distinct.size == passed.count)
        found += passed.count
      assert(n < 1000 || found > 300)

  test("no ray looks into nodes without photons"):
    // Nine leaves of sixteen have some
    val made = tree(photons(Draws(3), 65).map(_.copy(_2 = 0)), 0.2f)
    val ray = Ray()
    ray.set(Vec3(0, 0, -9), Vec3.Z, Float.PositiveInfinity)
    assert(made.passes(ray, 1))
    assert((Seq(7, 13, 14, 15) ++ (25 to 31)).forall(!made.passes(ray, _)))

  test("a few photons of many are the right number on average"):
    val tracer = new PhotonTracer(seed = 7):
      def raysTraced: Long = 0L
      protected def trace(time: Float, sampler: Sampler, photons: Photons): Unit = ()
    for n <- Vector(1, 5, 15, 16, 40) do
      val all = Photons()
      for i <- 1 to n do all.add(Vec3(i.toFloat, 0, 0), Vec3.Z, Rgb.White, place = 0)
      val passes = 20000
      val found = Array.fill(n)(0)
      for pass <- 0 until passes do
        val few = PhotonMap(Array(all), paths = 1, 1f, tracer.draw(pass)).fewInMedia
        for i <- 0 until few.count do found(few.data(i * PhotonMap.Numbers).toInt - 1) += 1
      // Each photon in one pass of sixteen, 1250, with a deviation of 34
      assert(found.forall(f => Math.abs(f - passes / 16) < 150), found.toVector)

  test("photons at one place, or in one plane, are found"):
    for places <- Vector(Vec3.Zero, Vec3(1, 0, 0)) do
      val all = Vector.tabulate(100)(i => (places * (i * 1e-3f), 0, 1))
      val ray = Ray()
      ray.set(Vec3(.02f, 0, -1), Vec3.Z, Float.PositiveInfinity)
      val passed = PassedPhotons()
      tree(all, 1f).query(ray, 0, 1, passed)
      assert(passed.count == 100)

  test("a tree that nobody waits for any more is given up"):
    val one = Photons()
    one.add(Vec3.Zero, Vec3.Z, Rgb.White, place = 0)
    intercept[GivenUp](PhotonTree(Array.fill(100)(one), 1, 1f, isStopped = () => true))
