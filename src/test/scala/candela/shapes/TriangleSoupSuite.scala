package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Hit, ShadingPoint}
import candela.math.*
import candela.testing.{Draws, Soups}

class TriangleSoupSuite extends AnyFunSuite:
  private val at = ShadingPoint()
  private val (p0, p1, p2) = (Vec3(1f, 0f, 2f), Vec3(3f, 0f, 2f), Vec3(1f, 4f, 2f))

  private def soup(
      normals: Array[Float] = Array.empty,
      uvs: Array[Float] = Array.empty,
      flipped: Boolean = false,
      tangents: Boolean = true
  ): TriangleSoup =
    // The second of two meshes, so that all offsets count
    val positions = Seq(p0, p1, p2, p0, p1, p2).flatMap(p => Seq(p.x, p.y, p.z)).toArray
    val first = Mesh(0, 0, 1, Array.empty, Array.empty, false, material = 5, firstLight = -1)
    val second = Mesh(3, 1, 1, normals, uvs, flipped, material = 9, firstLight = 40)
    TriangleSoup(positions, Array.range(0, 6), Array(first, second), tangents)

  private def look(soup: TriangleSoup, u: Float, v: Float, triangle: Int = 1): ShadingPoint =
    val hit = Hit()
    hit.u = u
    hit.v = v
    soup.surface(triangle, hit, at)
    at

  private def near(a: Vec3, b: Vec3) =
    // unit vectors, made by a handful of Float operations
    assert((a - b).length < 1e-6f, s"$a instead of $b")

  test("the weights are those of the second and the third corner"):
    assert(look(soup(), 0f, 0f).p == p0)
    assert(look(soup(), 1f, 0f).p == p1)
    assert(look(soup(), 0f, 1f).p == p2)
    assert(look(soup(), 0.25f, 0.5f).p == Vec3(1.5f, 2f, 2f))

  test("the point is in the plane up to its error bound"):
    val draws = Draws(1)
    for _ <- 0 until 100000 do
      val size = draws.magnitude(1e-3, 1e4)
      val (a, b, c) = Soups.randomTriangles(draws, 1, size)(draws.vec(-9, 9) * size).head
      val s = draws.unit()
      val at = look(Soups.of(Seq((a, b, c))), s * 0.5f, s * 0.3f, triangle = 0)
      def sub(p: Vec3) = Array(p.x.toDouble - a.x, p.y.toDouble - a.y, p.z.toDouble - a.z)
      val (e, f, q) = (sub(b), sub(c), sub(at.p))
      val n = Array(
        e(1) * f(2) - e(2) * f(1),
        e(2) * f(0) - e(0) * f(2),
        e(0) * f(1) - e(1) * f(0)
      )
      val off = Math.abs(n(0) * q(0) + n(1) * q(1) + n(2) * q(2))
      val bound = Math.abs(n(0)) * at.pError.x + Math.abs(n(1)) * at.pError.y +
        Math.abs(n(2)) * at.pError.z
      assert(off <= bound, s"$a $b $c ${at.p}")

  test("corners wind counter-clockwise seen from the outside, unless flipped"):
    assert(look(soup(), 0.2f, 0.2f).geometricNormal == Vec3.Z)
    assert(at.frame.n == Vec3.Z)
    assert(look(soup(flipped = true), 0.2f, 0.2f).geometricNormal == -Vec3.Z)
    assert(at.frame.n == -Vec3.Z)

  test("shading normals are interpolated, and turn the geometric normal to their side"):
    val slanted = Array[Float](0, 0, 1, 2, 0, 0, 0, 3, 0)
    for flipped <- Seq(false, true) do
      val s = soup(normals = slanted, flipped = flipped)
      near(look(s, 0.25f, 0.25f).frame.n, Vec3(0.5f, 0.75f, 0.5f).normalized)
      assert(at.geometricNormal == Vec3.Z)
      val down = soup(normals = slanted.map(-_), flipped = flipped)
      near(look(down, 0.25f, 0.25f).frame.n, -Vec3(0.5f, 0.75f, 0.5f).normalized)
      assert(at.geometricNormal == -Vec3.Z)

  test("shading normals that cancel leave the facet's"):
    val s = soup(normals = Array(0, 1, 0, 0, -1, 0, 0, 0, 0))
    assert(look(s, 0.5f, 0f).frame.n == Vec3.Z)

  test("without uvs the corners are (0,0), (1,0), (1,1)"):
    def uv(u: Float, v: Float) =
      look(soup(), u, v)
      (at.u, at.v)
    assert(uv(0, 0) == (0f, 0f) && uv(1, 0) == (1f, 0f) && uv(0, 1) == (1f, 1f))
    assert(uv(0.25f, 0.5f) == (0.75f, 0.5f))

  test("uvs are interpolated"):
    look(soup(uvs = Array(0, 0, 4, 0, 0, 8)), 0.25f, 0.5f)
    assert(at.u == 1f && at.v == 4f)

  test("the frame's s runs along growing u"):
    look(soup(), 0.2f, 0.2f)
    near(at.frame.s, Vec3.X)
    val draws = Draws(2)
    for _ <- 0 until 10000 do
      // p0 + u·a + v·b at random uvs: ∂p/∂u is a
      val (a, b) = (draws.direction(), draws.direction())
      val uvs = Array.fill(6)(draws.between(-1, 1))
      def corner(i: Int) = a * uvs(2 * i) + b * uvs(2 * i + 1)
      val area = (uvs(2) - uvs(0)) * (uvs(5) - uvs(1)) - (uvs(4) - uvs(0)) * (uvs(3) - uvs(1))
      if abs(area) > 0.1f && (a cross b).length > 0.1f then
        val positions =
          Seq(corner(0), corner(1), corner(2)).flatMap(p => Seq(p.x, p.y, p.z)).toArray
        val mesh = Mesh(0, 0, 1, Array.empty, uvs, draws.coin(), 0, -1)
        look(TriangleSoup(positions, Array(0, 1, 2), Array(mesh), true), 0.3f, 0.3f, 0)
        // round-offs of corners of size 2, over areas down to 0.1 · 0.1
        assert((at.frame.s - a).length < 1e-4f)
        assert(abs(at.frame.s dot at.frame.n) < 1e-6f): Unit

  test("with degenerate uvs there is a frame nevertheless"):
    look(soup(uvs = Array(0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f)), 0.2f, 0.2f)
    near(at.frame.s cross at.frame.t, Vec3.Z)

  test("one pair of uv is that of all vertices"):
    val one = Array(0.3f, -0.7f)
    def seen(uvs: Array[Float]) =
      val at = look(soup(uvs = uvs), 0.2f, 0.3f)
      (at.u, at.v, at.frame.s.toVec3)
    assert(seen(one) == seen(one ++ one ++ one))
    assert(Math.abs(at.u - 0.3f) < 1e-6f && Math.abs(at.v + 0.7f) < 1e-6f)

  test("where no one asks for u, the frame is any around the normal"):
    look(soup(tangents = false), 0.2f, 0.2f)
    assert(at.frame.n == Vec3.Z)
    near(at.frame.s cross at.frame.t, Vec3.Z)

  test("material and light are those of the mesh; lights count up with its triangles"):
    look(soup(), 0.2f, 0.2f)
    assert(at.material == 9 && at.areaLight == 40)
    look(soup(), 0.2f, 0.2f, triangle = 0)
    assert(at.material == 5 && at.areaLight == -1)
    val two = Soups.of(Seq((p0, p1, p2), (p0, p2, p1)))
    val lit = Mesh(0, 0, 2, Array.empty, Array.empty, false, 0, firstLight = 7)
    look(new TriangleSoup(two.positions, two.indices, Array(lit), true), 0f, 0f)
    assert(at.areaLight == 8)

  test("each triangle knows its mesh, of meshes of any size, some empty"):
    val sizes = Vector(0, 1, 40, 0, 0, 3, 16, 1, 1, 200, 15, 0)
    val firsts = sizes.scanLeft(0)(_ + _)
    val meshes = sizes.indices.map: i =>
      Mesh(0, firsts(i), sizes(i), Array.empty, Array.empty, false, material = i, firstLight = -1)
    val all = TriangleSoup(new Array(9), new Array(3 * firsts.last), meshes.toArray, false)
    val expected = sizes.indices.flatMap(i => Vector.fill(sizes(i))(i))
    assert((0 until all.count).map(all.meshOf) == expected)
