package candela.math

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

class TransformSuite extends AnyFunSuite:

  /** The transforms are Double inside: what is left is the rounding of the results to Float. */
  private def near(a: Vec3, b: Vec3, size: Float = 1f): Assertion =
    assert((a - b).length <= 4 * MachineEpsilon * (size + b.length), s"$a instead of $b")

  private def affine(draws: Draws): Transform =
    draws.translation(5) * draws.rotation() * draws.stretch() * draws.rotation()

  test("a product applies the right factor first"):
    val turn = Transform.rotate(90, 0, 0, 1).get
    val move = Transform.translate(1, 0, 0)
    near((turn * move).point(Vec3.Zero), Vec3.Y)
    near((move * turn).point(Vec3.Zero), Vec3.X)
    val draws = Draws(1)
    for _ <- 0 until 1000 do
      val (a, b, p) = (affine(draws), affine(draws), draws.vec(-3, 3))
      near((a * b).point(p), a.point(b.point(p)), size = 200f) // stretched twice on the way

  test("the inverse undoes points and vectors, and inverts products"):
    val draws = Draws(2)
    for _ <- 0 until 1000 do
      val (t, p) = (affine(draws), draws.vec(-3, 3))
      near(t.inverse.point(t.point(p)), p, size = 200f) // shrinks by up to 4, after up to 40 away
      near(t.inverse.vector(t.vector(p)), p, size = 200f)
      val product = t * affine(draws)
      val unit = product * product.inverse
      for i <- 0 until 16 do
        // Double products of factors up to 100 with unit round-off 1.1e-16
        assert(Math.abs(unit.m(i) - (if i % 5 == 0 then 1 else 0)) < 1e-12, unit)

  test("an inverse that was computed is one"):
    val draws = Draws(3)
    for _ <- 0 until 1000 do
      val t = affine(draws)
      val again = Transform.fromRows(t.m).get
      // condition numbers to 16, sizes to 20: far below 1e-11 in Double
      for i <- 0 until 16 do assert(Math.abs(again.inverseM(i) - t.inverseM(i)) < 1e-11)

  test("vectors ignore translations, points do not"):
    val t = Transform.translate(1, 2, 3)
    assert(t.vector(Vec3.X) == Vec3.X && t.point(Vec3.X) == Vec3(2f, 2f, 3f))

  test("normals stay perpendicular to what was the surface, and outside stays outside"):
    val draws = Draws(4)
    for _ <- 0 until 10000 do
      val t = affine(draws)
      val (a, b) = (draws.direction(), draws.direction())
      val n = a cross b
      val (wn, wa, wb) = (t.normal(n).normalized, t.vector(a), t.vector(b))
      // three roundings of unit-size numbers, stretched by up to 16 relative to n's own size
      assert((wn absDot wa.normalized) < 1e-5f / Math.max(n.length, 0.01f))
      assert((wn absDot wb.normalized) < 1e-5f / Math.max(n.length, 0.01f))
      assert((t.normal(n) dot t.vector(n)) > 0f) // also for the half of them that mirror

  test("rotation is counter-clockwise about an axis of any length, by degrees"):
    near(Transform.rotate(90, 0, 0, 7).get.vector(Vec3.X), Vec3.Y)
    near(Transform.rotate(90, 1, 0, 0).get.vector(Vec3.Y), Vec3.Z)
    near(Transform.rotate(90, 0, 0.1, 0).get.vector(Vec3.Z), Vec3.X)
    near(Transform.rotate(120, 1, 1, 1).get.vector(Vec3.X), Vec3.Y)
    assert(Transform.rotate(30, 0, 0, 0).isEmpty)
    val draws = Draws(5)
    for _ <- 0 until 1000 do
      val (r, v) = (draws.rotation(), draws.direction())
      near(r.inverse.vector(r.vector(v)), v)
      assert(abs(r.vector(v).length - 1f) < 4 * MachineEpsilon)

  test("lookAt is left-handed: x to the right, y up, z forward"):
    val t = Transform.lookAt(Seq(3, 4, 5), Seq(3, 4, 15), Seq(0, 2, 0)).get
    near(t.point(Vec3(3f, 4f, 5f)), Vec3.Zero)
    near(t.vector(Vec3.Z), Vec3.Z)
    near(t.vector(Vec3.Y), Vec3.Y)
    near(t.vector(Vec3.X), Vec3.X)
    // Seen along −z with y up, world +x is on the left
    val back = Transform.lookAt(Seq(0, 0, 10), Seq(0, 0, 0), Seq(0, 1, 0)).get
    near(back.vector(Vec3.X), -Vec3.X)
    near(back.point(Vec3.Zero), Vec3.Z * 10f)
    // Left-handed: looking down x with z up, y is on the right
    val down = Transform.lookAt(Seq(0, 0, 0), Seq(1, 0, 0), Seq(0, 0, 1)).get
    near(down.vector(Vec3.Y), Vec3.X)
    near(down.vector(Vec3.Z), Vec3.Y)

  test("lookAt keeps lengths, puts the target straight ahead and up in the upper half plane"):
    val draws = Draws(6)
    for _ <- 0 until 1000 do
      val (e, l, u) = (draws.vec(-9, 9), draws.vec(-9, 9), draws.direction())
      def seq(v: Vec3) = Seq(v.x.toDouble, v.y.toDouble, v.z.toDouble)
      val t = Transform.lookAt(seq(e), seq(l), seq(u)).get
      val ahead = t.point(l)
      near(ahead, Vec3(0f, 0f, (l - e).length), size = 20f)
      assert(abs(t.vector(u).x) < 1e-6f && t.vector(u).y > 0f)
      assert(!t.swapsHandedness)

  test("lookAt without a direction, or with up along it, is none"):
    val (o, z) = (Seq(0.0, 0.0, 0.0), Seq(0.0, 0.0, 1.0))
    assert(Transform.lookAt(o, o, z).isEmpty)
    assert(Transform.lookAt(o, z, z).isEmpty)
    assert(Transform.lookAt(o, z, o).isEmpty)
    assert(Transform.lookAt(Seq(0.1, 0.2, 0.3), Seq(0.8, 0.7, 0.4), Seq(2.1, 1.5, 0.3)).isEmpty)

  test("a negative determinant swaps handedness, and only that"):
    assert(!Transform.Identity.swapsHandedness)
    assert(Transform.scale(-1, 1, 1).get.swapsHandedness)
    assert(!Transform.scale(-1, -2, 1).get.swapsHandedness)
    assert(Transform.scale(-1, -2, -3).get.swapsHandedness)
    val draws = Draws(7)
    for _ <- 0 until 1000 do
      val (a, b) = (affine(draws), affine(draws))
      assert((a * b).swapsHandedness == (a.swapsHandedness != b.swapsHandedness))
      assert(a.inverse.swapsHandedness == a.swapsHandedness)

  test("columns are the order of scene files: a translation is in the last four numbers"):
    val t = Transform.fromColumns(Vector(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1)).get
    assert(t == Transform.translate(5, 6, 7))
    val rows = Transform.fromRows(Vector(1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1)).get
    assert(rows == t)

  test("what can't be inverted is none, also where rounding hides that the rows depend"):
    assert(Transform.scale(1, 0, 1).isEmpty)
    assert(Transform.fromRows(Vector.fill(16)(0.0)).isEmpty)
    assert(Transform.fromRows(Vector.tabulate(16)(i => if i == 0 then Double.NaN else i)).isEmpty)
    def linear(rows: Double*) =
      Transform.fromRows(
        rows.grouped(3).flatMap(_ :+ 0.0).toVector ++ Vector(0.0, 0.0, 0.0, 1.0)
      )
    assert(linear(1, 2, 3, 4, 5, 6, 7, 8, 9).isEmpty)
    assert(linear(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9).isEmpty)
    val draws = Draws(8)
    for _ <- 0 until 1000 do
      val (a, b) = (draws.vec(-1, 1), draws.vec(-1, 1))
      val (s, t) = (draws.between(-1, 1), draws.between(-1, 1))
      def sum(x: Float, y: Float) = s.toDouble * x + t.toDouble * y
      val c = Seq(sum(a.x, b.x), sum(a.y, b.y), sum(a.z, b.z))
      assert(linear(Seq[Double](a.x, a.y, a.z, b.x, b.y, b.z) ++ c*).isEmpty)

  test("very flat, very small and very sheared is not singular"):
    for s <- Seq(1e-12, 1e-6, 1e6, 1e12) do
      val flat = Transform.scale(1, s, 1).get
      assert(Transform.fromRows(flat.m).exists(_.inverseM(5) == 1 / s))
      val turned = Transform.rotate(33, 1, 2, 3).get * Transform.scale(s, s, s).get
      assert(Transform.fromRows(turned.m).isDefined)
      val sheared = Vector[Double](1, s, 0, 0, 0, 1, 0, 0, s, 0, 1, 0, 0, 0, 0, 1)
      assert(Transform.fromRows(sheared).isDefined)
    assert(Transform.fromRows(Vector[Double](1e-20, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1))
      .isDefined)

  test("transforms are equal if their numbers are"):
    assert(Transform.scale(1, 1, 1).get.isIdentity && !Transform.translate(0, 0, 1).isIdentity)
    assert(Transform.scale(1, 1, 1).get.hashCode == Transform.Identity.hashCode)
