package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Frame, Hit, ShadingPoint}
import candela.math.*
import candela.testing.Draws

class PartialsSuite extends AnyFunSuite:

  private def around(draws: Draws)(make: Transform => (Shape, Vec3)): Int =
    var compared = 0
    for _ <- 0 until 2000 do
      val toWorld = draws.rotation() * draws.stretch()
      val (shape, target) = make(toWorld)
      val d = draws.direction()
      val side = Frame.fromZ(d).s
      if PartialsLaws.check(shape, target - d * 10f, d, side, 0.003f, 4f) then compared += 1
    compared

  test("derivatives on spheres, stretched and cut, are those of finite differences"):
    val draws = Draws(1)
    val compared = around(draws): toWorld =>
      val sphere = Sphere(
        toWorld,
        1f,
        draws.between(-1.2f, -0.3f),
        draws.between(0.3f, 1.2f),
        draws.between(2f, TwoPi),
        draws.coin()
      )
      // Not near the poles, where u changes too fast for a finite difference
      val z = draws.between(-0.8f, 0.8f)
      val (r, phi) = (sqrt(1 - z * z), draws.between(0, TwoPi))
      (sphere, toWorld.point(Vec3(r * cos(phi), r * sin(phi), z)))
    assert(compared > 500)

  test("derivatives on disks are those of finite differences"):
    val draws = Draws(2)
    val compared = around(draws): toWorld =>
      val disk = Disk(toWorld, 0.3f, 1f, 0.2f, draws.between(1f, TwoPi), draws.coin())
      val (r, phi) = (draws.between(0.3f, 0.9f), draws.between(0, TwoPi))
      (disk, toWorld.point(Vec3(r * cos(phi), r * sin(phi), 0.3f)))
    assert(compared > 300)

  test("derivatives on swept quadrics are those of finite differences"):
    val draws = Draws(3)
    for kind <- 0 until 4 do
      val compared = around(draws): toWorld =>
        // So large that three steps aside see no other curvature
        val q = Quadrics.random(draws, kind, 20)
        // Not near a tip or an apex
        val p = q.point(draws.between(0.1f, 0.9f), draws.between(0.3f, 0.7f))
        val target = Vec3(p(0).toFloat, p(1).toFloat, p(2).toFloat)
        (q.placed(toWorld, draws.coin()), toWorld.point(target))
      assert(compared > 500, s"kind $kind")

  test("derivatives on bilinear patches are those of finite differences, whatever is given"):
    val draws = Draws(4)
    for i <- 0 until 8 do
      val compared = around(draws): toWorld =>
        val mesh = BilinearPatches.random(draws, toWorld, i % 2 == 1, i % 4 > 1, i > 3)
        val p = BilinearPatch.Corners(mesh, 0)
        (BilinearPatch(mesh, 0), p.point(draws.between(0.2f, 0.8f), draws.between(0.2f, 0.8f)))
      assert(compared > 500, s"case $i")

  private val corners = Seq(Vec3(1f, 0f, 2f), Vec3(3f, 0.5f, 2.5f), Vec3(1f, 4f, 1f))
  private val smooth = Array[Float](0.1f, 0.2f, 1f, 0.4f, -0.3f, 2f, -0.2f, 0.3f, 0.7f)

  private def triangle(
      normals: Array[Float],
      uvs: Array[Float],
      bumps: BumpTangents = BumpTangents.Along
  ) =
    val mesh = Mesh(0, 0, 1, normals, uvs, false, 0, -1, bumps)
    val positions = corners.flatMap(p => Seq(p.x, p.y, p.z)).toArray
    TriangleSoup(positions, Array(0, 1, 2), Array(mesh), true)

  private def look(soup: TriangleSoup, b1: Float, b2: Float): ShadingPoint =
    val (hit, at) = (Hit(), ShadingPoint(wantsPartials = true))
    hit.u = b1
    hit.v = b2
    soup.surface(0, hit, at)
    at

  test("derivatives on triangles are those of finite differences, whatever their parameters"):
    val h = 1e-3f
    val mirrored = Array[Float](0.2f, 0.1f, 0.3f, 1.4f, 1.7f, 0.2f)
    for
      normals <- Seq(Array.emptyFloatArray, smooth)
      uvs <- Seq(Array.emptyFloatArray, Array[Float](0, 0, 2, 1, -1, 3), mirrored)
      (e1, e2) <- Seq((h, 0f), (0f, h), (h, -h))
    do
      val soup = triangle(normals, uvs)
      val (a, m, b) = (
        look(soup, 0.3f - e1, 0.4f - e2),
        look(soup, 0.3f, 0.4f),
        look(soup, 0.3f + e1, 0.4f + e2)
      )
      val (du, dv) = (b.u - a.u, b.v - a.v)
      // 1 % of the step
      assert(((b.p - a.p) - (m.dpdu * du + m.dpdv * dv)).length < 1e-2f * (b.p - a.p).length)
      // dndu and dndv are of the normals as they are given: linear over the triangle
      val (c1, c2) = (2 * e1, 2 * e2)
      val parts = Seq(-c1 - c2, c1, c2).zip(normals.grouped(3)).map: (w, n) =>
        Vec3(n(0), n(1), n(2)) * w
      val change = parts.foldLeft(Vec3.Zero)(_ + _)
      assert((change - (m.dndu * du + m.dndv * dv)).length <= 1e-2f * change.length + 1e-7f)

  test("without a parameterisation the tangents are a unit frame in the triangle"):
    val at = look(triangle(Array.empty, Array.fill(6)(0.5f)), 0.3f, 0.4f)
    assert(abs(at.dpdu.length - 1) < 1e-6f && abs(at.dpdv.length - 1) < 1e-6f)
    assert(abs(at.dpdu dot at.geometricNormal) < 1e-6f && abs(at.dpdu dot at.dpdv) < 1e-6f)

  test("one pair of parameters is that of all vertices"):
    def seen(uvs: Array[Float]) =
      val at = look(triangle(smooth, uvs), 0.3f, 0.4f)
      Seq(at.dpdu, at.dpdv, at.dndu, at.dndv, at.tangentU, at.tangentV).map(_.toVec3)
    assert(seen(Array.fill(2)(0.5f)) == seen(Array.fill(6)(0.5f)))

  test("tangents for displacements are perpendicular to the shading normal"):
    val at = look(triangle(smooth, Array.empty), 0.3f, 0.4f)
    val ns = at.frame.n
    assert(abs(at.tangentU dot ns) < 1e-6f && abs(at.tangentV dot ns) < 1e-6f)
    assert((at.tangentU dot at.dpdu) > 0 && abs(at.tangentU.length - at.tangentV.length) < 1e-6f)
    val flat = look(triangle(Array.empty, Array.empty), 0.3f, 0.4f)
    assert(flat.tangentU == flat.dpdu && flat.tangentV == flat.dpdv)

  test("pbrt-v2's and v3's tangents for displacements are unit vectors, half turned around"):
    val plain = look(triangle(smooth, Array.empty), 0.3f, 0.4f)
    val turned = look(triangle(smooth, Array.empty, BumpTangents.Turned), 0.3f, 0.4f)
    assert((turned.tangentU + plain.tangentU.normalized).length < 1e-6f)
    assert((turned.tangentV + plain.tangentV.normalized).length < 1e-6f)
    assert((turned.dpdu - plain.dpdu).isZero && turned.bumpSide == 1f)
    assert(look(triangle(smooth, Array.empty, BumpTangents.ofV2(true)), 0f, 0f).bumpSide == -1f)
