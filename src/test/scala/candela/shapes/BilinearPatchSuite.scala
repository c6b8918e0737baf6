package candela.shapes

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.{ChiSquare, Draws}

class BilinearPatchSuite extends AnyFunSuite:
  import BilinearPatches.*

  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint()

  private def cornersOf(p: Seq[Vec3]) = new BilinearPatch.Corners(p(0), p(1), p(2), p(3))

  private def aim(draws: Draws, target: Vec3): Unit =
    val o = target + draws.direction() * draws.between(0.5f, 5)
    ray.set(o, (target - o).normalized, Float.PositiveInfinity)

  test("a ray that is aimed at (u, v) finds that point, or another before it"):
    val draws = Draws(1)
    var direct = 0
    for _ <- 0 until 20000 do
      val points = corners(draws)
      val patch = of(points)
      val p = cornersOf(points)
      val (u, v) = (draws.between(0.001f, 0.999f), draws.between(0.001f, 0.999f))
      val target = p.point(u, v)
      aim(draws, target)
      val n = (p.alongU(v) cross p.alongV(u)).normalized
      // Edge-on rounding decides
      if (n absDot ray.direction) > 1e-2f then
        assert(patch.isHit(ray))
        val distance = (target - ray.origin).length
        assert(patch.intersect(ray, hit) && ray.tMax < distance + 1e-4f)
        patch.surface(ray, hit, at)
        if ray.tMax > distance - 1e-4f then
          direct += 1
          assert(abs(at.u - u) < 1e-3f && abs(at.v - v) < 1e-3f)
          assert((at.p - target).length < 1e-3f)
          assert((at.geometricNormal - n).length < 1e-2f): Unit
    assert(direct > 15000)

  test("what many small triangles of it meet, the patch meets, and nothing else"):
    val draws = Draws(2)
    val n = 16
    var hits = 0
    for _ <- 0 until 300 do
      val points = corners(draws)
      val p = cornersOf(points)
      def q(i: Int, j: Int) = p.point(i.toFloat / n, j.toFloat / n)
      val facets = flat(
        for
          i <- 0 until n
          j <- 0 until n
          t <- Seq(q(i, j), q(i + 1, j), q(i + 1, j + 1), q(i, j), q(i + 1, j + 1), q(i, j + 1))
        yield t
      )
      val patch = of(points)
      for _ <- 0 until 20 do
        aim(draws, Vec3(draws.between(-0.3f, 1.3f), draws.between(-0.3f, 1.3f), 0))
        var closest = Float.PositiveInfinity
        for k <- 0 until facets.length / 9 do
          ray.tMax = Float.PositiveInfinity
          if TriangleTest.intersect(facets, 9 * k, ray, hit) then
            closest = Math.min(closest, ray.tMax)
        ray.tMax = Float.PositiveInfinity
        val found = patch.intersect(ray, hit)
        if found && closest < Float.PositiveInfinity then
          hits += 1
          patch.surface(ray, hit, at)
          // Facets cut corners by a 1/16² of the twist, seen at an angle
          val slope = Math.max(0.05f, at.geometricNormal absDot ray.direction)
          assert(abs(ray.tMax - closest) < 0.01f / slope): Unit
        else if found != closest < Float.PositiveInfinity then
          // Only where the ray passes an edge, or the fold against which it grazes
          if found then
            patch.surface(ray, hit, at)
            val margin = Seq(at.u, at.v, 1 - at.u, 1 - at.v).min
            assert(margin < 0.05f || (at.geometricNormal absDot ray.direction) < 0.15f): Unit
    assert(hits > 1500)

  test("no ray passes between patches that share an edge, flat or bent"):
    val draws = Draws(3)
    for i <- 0 until 20000 do
      val size = draws.magnitude(1e-2, 1e2)
      val away = draws.direction() * (size * draws.magnitude(1, 1000))
      def wide(p: Vec3) = p * size + away
      val (a, b) = (draws.vec(-0.2f, 0.2f), draws.vec(-0.2f, 0.2f) + Vec3.Y)
      val (left, right) = (
        of(Seq(Vec3(-1, 0, 0) + draws.vec(-0.2f, 0.2f), a, Vec3(-1, 1, 0), b).map(wide)),
        of(Seq(a, Vec3(1, 0, 0.5f), b, Vec3(1, 1, 0) + draws.vec(-0.2f, 0.2f)).map(wide))
      )
      val target = wide(a + (b - a) * draws.unit())
      val from = target + (Vec3.Z + draws.vec(-0.4f, 0.4f)) * (size * draws.between(1, 20))
      ray.set(from, (target - from).normalized, Float.PositiveInfinity)
      assert(left.isHit(ray) || right.isHit(ray), s"try $i")

  test("patches of three different corners, or of parallel edges, are met as well"):
    val square = Seq(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0))
    val triangles = Seq((0, 1), (0, 2), (3, 1), (3, 2)).map((a, b) => square.updated(a, square(b)))
    for (points, i) <- (square +: triangles).zipWithIndex do
      val draws = Draws(i)
      val p = cornersOf(points)
      for _ <- 0 until 1000 do
        val target = p.point(draws.between(0.01f, 0.99f), draws.between(0.01f, 0.99f))
        val from = target + Vec3(draws.between(-1, 1), draws.between(-1, 1), 1)
        ray.set(from, target - from, Float.PositiveInfinity)
        assert(of(points).intersect(ray, hit) && abs(ray.tMax - 1f) < 1e-5f, s"$i $target")

  test("rays that leave a patch don't meet it again at once, and a flat one not at all", Slow):
    val draws = Draws(4)
    var spawned = 0
    while spawned < 50000 do
      val size = draws.magnitude(1e-3, 1e3)
      val away = draws.direction() * (size * draws.magnitude(1e-2, 300))
      val isFlat = draws.coin()
      val bent = corners(draws)
      val points = (if isFlat then Seq(bent(0), bent(1), bent(2), bent(1) + bent(2) - bent(0))
                    else bent).map(_ * size + away)
      val patch = of(points)
      val p = cornersOf(points)
      val target = p.point(draws.unit(), draws.unit())
      val o = target + draws.direction() * size
      ray.set(o, (target - o).normalized, Float.PositiveInfinity)
      if patch.intersect(ray, hit) then
        patch.surface(ray, hit, at)
        val d = draws.direction()
        ray.set(at.offsetOrigin(d), d, Float.PositiveInfinity)
        val steep = (d absDot at.geometricNormal) > 0.3f
        // The corners of a "flat" one are rounded: it may bend by some ulps
        if steep then
          val again = patch.intersect(ray, hit)
          assert(!again || (!isFlat && ray.tMax > 0.01f * size), s"$size $isFlat ${ray.tMax}"): Unit
        spawned += 1

  test("rays that leave a patch in a plane of a coordinate don't meet it, not even at zero"):
    val draws = Draws(8)
    for _ <- 0 until 30000 do
      val axis = draws.below(3)
      val height = if draws.coin() then 0f else draws.between(-2, 2)
      def put(p: Vec3) = Vec3(
        if axis == 0 then height else p.x,
        if axis == 1 then height else p.y,
        if axis == 2 then height else if axis == 0 then p.x else p.y
      )
      val patch = of(corners(draws).map(p => put(p * 9f)))
      val d = draws.direction()
      ray.set(patch.bounds.center - d * 3f, d, Float.PositiveInfinity)
      if patch.intersect(ray, hit) then
        patch.surface(ray, hit, at)
        val leave = draws.direction()
        ray.set(at.offsetOrigin(leave), leave, Float.PositiveInfinity)
        assert(!patch.isHit(ray), s"${at.p} $leave"): Unit

  test("the area is that of small facets, and of a parallelogram exact"):
    val draws = Draws(5)
    for _ <- 0 until 50 do
      val points = corners(draws)
      val p = cornersOf(points)
      val n = 50
      val facets: Seq[Double] =
        for i <- 0 until n; j <- 0 until n yield
          def q(a: Int, b: Int) = p.point((i + a).toFloat / n, (j + b).toFloat / n)
          ((q(1, 1) - q(0, 0)) cross (q(0, 1) - q(1, 0))).length * 0.5
      assert(Math.abs(of(points).area / facets.sum - 1) < 5e-4)
    val skew = Seq(Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(1, 2, 0), Vec3(4, 2, 0))
    assert(abs(of(skew).area - 6f) < 1e-5f)

  test("samples have the density that the pdf says, and are where the normals' cone says", Slow):
    val draws = Draws(6)
    for i <- 0 until 6 do
      val flipped = i % 2 == 1
      val points = if i < 2 then Seq(Vec3.Zero, Vec3.X, Vec3.Y, Vec3(1, 1, 0)) else corners(draws)
      val patch = of(points, flipped)
      val p = cornersOf(points)
      val from = Vec3(0.3f, 0.4f, 1.5f)
      val out = SurfaceSample()
      val (axis, cosine) = patch.normals
      val result = ChiSquare.square(seed = i)(
        u =>
          patch.sample(from, u(), u(), out)
          assert((axis dot out.n) >= cosine - 1e-4f)
          // Where it is on the patch, by a ray along the normal
          ray.set(out.p + out.n * 0.1f, -out.n, Float.PositiveInfinity)
          Option.when(patch.intersect(ray, hit))(Vec3(hit.u.toFloat, hit.v.toFloat, 0))
        ,
        (u, v) =>
          val q = p.point(u.toFloat, v.toFloat)
          val facet = p.alongU(v.toFloat) cross p.alongV(u.toFloat)
          val d = q - from
          val n = facet.normalized
          val perSolidAngle = patch.pdf(from, q, n).toDouble
          perSolidAngle * (n absDot d.normalized) / d.lengthSquared * facet.length
      )
      assert(result.accepted(tests = 6), result)
      SampledShapes.pdfAgrees(patch, from, draws, relative = 1e-4f)
      val see = SampledShapes.visible(patch)
      if i > 3 then
        val _ = SampledShapes.integrates(patch, see, from, draws)(w => 1 + w.x + w.y * w.z)

  test("bounds hold all points; normals given decide on the outside"):
    val draws = Draws(7)
    for _ <- 0 until 1000 do
      val mesh = random(draws, Transform.Identity, true, true, draws.coin())
      val patch = BilinearPatch(mesh, 0)
      val p = BilinearPatch.Corners(mesh, 0)
      val q = p.point(draws.unit(), draws.unit())
      // A blend is rounded once
      val near = patch.bounds
      assert(near.union(q).extent.length <= near.extent.length * (1 + 1e-6f))
      ray.set(q + Vec3.Z, -Vec3.Z, Float.PositiveInfinity)
      if patch.intersect(ray, hit) then
        patch.surface(ray, hit, at)
        assert((at.geometricNormal dot at.frame.n) > 0 && at.frame.n.z > 0): Unit
