package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.{ChiSquare, Draws}

/** Areas of swept quadrics, and points chosen on them. */
class QuadricSamplingSuite extends AnyFunSuite:
  private def times(m: IArray[Double], v: Array[Double], w: Double): Array[Double] =
    Array.tabulate(3)(i =>
      m(4 * i) * v(0) + m(4 * i + 1) * v(1) + m(4 * i + 2) * v(2) + m(4 * i + 3) * w
    )
  private def doubles(v: Vec3): Array[Double] = Array(v.x, v.y, v.z)
  private def floats(v: Array[Double]): Vec3 = Vec3(v(0).toFloat, v(1).toFloat, v(2).toFloat)
  private def minus(a: Array[Double], b: Array[Double]) = Array.tabulate(3)(i => a(i) - b(i))
  private def norm(a: Array[Double]) = Math.sqrt(a.map(x => x * x).sum)
  private def cross(a: Array[Double], b: Array[Double]) = Array(
    a(1) * b(2) - a(2) * b(1),
    a(2) * b(0) - a(0) * b(2),
    a(0) * b(1) - a(1) * b(0)
  )

  test("the area is that of the swept line, by summing small facets"):
    val draws = Draws(5)
    for i <- 0 until 8 do
      val q = Quadrics.random(draws, i, 1)
      val toWorld = draws.rotation() * draws.stretch() * draws.rotation()
      def p(u: Double, v: Double) = times(toWorld.m, q.point(u, v), 1)
      val n = 160
      val facets =
        for a <- 0 until n; b <- 0 until n yield
          val (u, v, h) = (a.toDouble / n, b.toDouble / n, 1.0 / n)
          val (e, f) = (minus(p(u + h, v + h), p(u, v)), minus(p(u, v + h), p(u + h, v)))
          0.5 * norm(cross(e, f))
      // Facets are too small by about h²; of a paraboloid's √z at its apex by h
      val slack = if q.name == "paraboloid" then 5e-3 else 1e-3
      assert(Math.abs(q.placed(toWorld).area / facets.sum - 1) < slack, q.name)

  test("areas of simple bodies are those of the textbook"):
    def area(q: SweptQuadric, scale: Double = 1) =
      q.placed(Transform.translate(3, 4, 5) * Transform.scale(scale, -scale, scale).get).area
    def near(x: Float, y: Double) = assert(Math.abs(x / y - 1) < 1e-6)
    near(area(Quadrics.cylinder(2, -1, 3, TwoPi)), 2 * Math.PI * 2 * 4)
    near(area(Quadrics.cylinder(2, -1, 3, 1), 2), 2 * 4 * 4)
    near(area(Quadrics.cone(3, 4, TwoPi)), Math.PI * 3 * 5)
    near(area(Quadrics.paraboloid(1, 0, 1, TwoPi)), Math.PI / 6 * (Math.pow(5, 1.5) - 1))
    val stretched = Sphere(Transform.scale(1, 1, 2).get, 1, -1, 1, TwoPi, false)
    // a prolate spheroid: 2π(1 + 2/e·asin e), e = √3/2
    val e = Math.sqrt(3) / 2
    near(stretched.area, 2 * Math.PI * (1 + 2 / e * Math.asin(e)))

  for kind <- 0 until 4; name = Quadrics.random(Draws(0), kind, 1).name do
    test(s"samples of a $name are as dense as the pdf says, in whole and in part"):
      val draws = Draws(20 + kind)
      val toWorld = draws.rotation() * Transform.scale(-1, 0.6, 1.3).get
      val shape = Quadrics.random(draws, kind, 1).placed(toWorld, reversed = draws.coin())
      val from = shape.bounds.center + draws.direction() * 0.4f
      val see = SampledShapes.visible(shape)
      val result = density(draws, kind, toWorld)
      assert(result.accepted(tests = 4), result)
      // Near a tip the density is that of its distance, which has lost some digits
      SampledShapes.pdfAgrees(shape, from, draws, relative = 1e-3f)
      val far = shape.bounds.center + draws.direction() * 2.5f
      SampledShapes.integrates(shape, see, far, draws)(w => 1 + w.x + w.y * w.z)

  /** Of samples in (u, v), whose expected density is that of the swept line's facets. */
  private def density(draws: Draws, kind: Int, toWorld: Transform): ChiSquare.Result =
    val q = Quadrics.random(draws, kind, 1)
    val shape = q.placed(toWorld)
    val from = shape.bounds.center
    val out = SurfaceSample()
    def p(u: Double, v: Double) = times(toWorld.m, q.point(u, v), 1)
    ChiSquare.square(seed = kind, draws = 50000, columns = 12, rows = 12)(
      u =>
        shape.sample(from, u(), u(), out)
        val o = times(toWorld.inverseM, doubles(out.p), 1)
        val (s, t) = (q.profile.angle(o(0), o(1), o(2)) / q.phiMax, q.profile.v(o(2)))
        Some(Vec3(Math.min(1.0, s).toFloat, Math.max(0.0, Math.min(1.0, t)).toFloat, 0f))
      ,
      (u, v) =>
        val h = 1e-5
        val facet = cross(minus(p(u + h, v), p(u - h, v)), minus(p(u, v + h), p(u, v - h)))
        val n = floats(facet).normalized
        val d = minus(p(u, v), doubles(from))
        val distance = norm(d)
        val cosine = Math.abs(d(0) * n.x + d(1) * n.y + d(2) * n.z) / distance
        val perArea = shape.pdf(from, floats(p(u, v)), n) * cosine / (distance * distance)
        perArea * norm(facet) / (4 * h * h)
    )
