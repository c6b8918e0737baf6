package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

class NurbsSuite extends AnyFunSuite:

  private def knots(count: Int, order: Int, draws: Draws): KnotVector =
    // Clamped at both ends, some inner ones double
    val inner = Seq.fill(count - order)(draws.below(5) * 0.2).map(_ + 0.1).sorted
    KnotVector(count, order, (Seq.fill(order)(0.0) ++ inner ++ Seq.fill(order)(1.0)).toArray)

  test("the weights are a partition of one, and their slopes finite differences"):
    val draws = Draws(1)
    for _ <- 0 until 2000 do
      val order = 2 + draws.below(4)
      val k = knots(order + draws.below(5), order, draws)
      val t = draws.between(0.001f, 0.999f).toDouble
      val (w, d) = k.weights(t)
      assert(w.forall(x => x >= 0 && x <= 1 + 1e-12) && Math.abs(w.sum - 1) < 1e-12)
      assert(Math.abs(d.sum) < 1e-10)
      val h = 1e-6
      // Within one span
      if k.first(t - h) == k.first(t + h) then
        val (a, b) = (k.weights(t - h)._1, k.weights(t + h)._1)
        for i <- w.indices do
          assert(Math.abs((b(i) - a(i)) / (2 * h) - d(i)) < 1e-3 * (1 + Math.abs(d(i))))

  test("the ends of a clamped vector are its first and last control points"):
    val k = KnotVector(5, 3, Array(0, 0, 0, 0.3, 0.6, 1, 1, 1))
    assert(k.first(0) == 0 && k.weights(0)._1.sameElements(Array(1.0, 0, 0)))
    assert(k.first(1) == 2 && Math.abs(k.weights(1)._1(2) - 1) < 1e-15)

  test("rational weights make a cylinder round, with normals across it"):
    val r = Math.sqrt(0.5)
    val quarter = KnotVector(3, 3, Array(0, 0, 0, 1, 1, 1))
    val line = KnotVector(2, 2, Array(0, 0, 1, 1))
    val ring = Seq((1.0, 0.0, 1.0), (1.0, 1.0, r), (0.0, 1.0, 1.0))
    val points = for z <- Seq(0.0, 2.0); (x, y, w) <- ring yield Seq(x * w, y * w, z * w, w)
    val surface = Nurbs(quarter, line, points.flatten.toArray)
    for i <- 0 to 20; j <- 0 to 4 do
      val p = surface.at(i / 20.0, j / 4.0)
      assert(Math.abs(Math.hypot(p(0), p(1)) - 1) < 1e-12 && Math.abs(p(2) - j / 2.0) < 1e-12)
      val length = Math.sqrt(p(3) * p(3) + p(4) * p(4) + p(5) * p(5))
      assert(Math.abs(p(3) / length - p(0)) < 1e-12 && Math.abs(p(4) / length - p(1)) < 1e-12)

  test("the normal is the cross product of finite differences"):
    val draws = Draws(2)
    for _ <- 0 until 200 do
      val (ku, kv) = (knots(6, 3, draws), knots(5, 4, draws))
      val points = Array.tabulate(4 * 30): i =>
        val (u, v) = (i / 4 % 6, i / 24)
        val w = draws.between(0.5f, 2).toDouble
        i % 4 match
          case 0 => u + draws.between(-0.2f, 0.2f).toDouble
          case 1 => v + draws.between(-0.2f, 0.2f).toDouble
          case 2 => draws.unit().toDouble
          case _ => w
      val surface = Nurbs(ku, kv, points)
      val (s, t, h) = (draws.between(0.01f, 0.99f), draws.between(0.01f, 0.99f), 1e-6)
      val oneSpan = ku.first(s - h) == ku.first(s + h) && kv.first(t - h) == kv.first(t + h)
      if oneSpan then
        def p(a: Double, b: Double) = surface.at(s + a, t + b)
        val u = Array.tabulate(3)(k => (p(h, 0)(k) - p(-h, 0)(k)) / (2 * h))
        val v = Array.tabulate(3)(k => (p(0, h)(k) - p(0, -h)(k)) / (2 * h))
        val n = Array.tabulate(3): k =>
          val (i, j) = ((k + 1) % 3, (k + 2) % 3)
          u(i) * v(j) - u(j) * v(i)
        val size = n.map(Math.abs).max
        for k <- 0 until 3 do assert(Math.abs(p(0, 0)(3 + k) - n(k)) < 1e-6 * (1 + size))
