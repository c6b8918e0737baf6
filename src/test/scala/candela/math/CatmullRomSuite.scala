package candela.math

import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

class CatmullRomSuite extends AnyFunSuite:
  private val nodes = Array(-1f, -0.4f, -0.1f, 0.3f, 0.35f, 1f, 2.5f)
  private def values(f: Float => Float) = nodes.map(f)
  private val hills = values(x => 1f + 0.5f * sin(3f * x))
  private val rising = values(x => x + 0.2f * sin(2f * x))

  test("straight lines are kept, and so are the values at nodes"):
    val draws = Draws(1)
    for _ <- 0 until 1000 do
      val x = draws.between(-1f, 2.5f)
      // A few roundings of numbers up to 8
      assert(Math.abs(CatmullRom.value(nodes, values(3f * _ + 0.5f), x) - (3f * x + 0.5f)) < 5e-6f)
    for i <- nodes.indices do
      assert(Math.abs(CatmullRom.value(nodes, hills, nodes(i)) - hills(i)) < 1e-6f)

  test("the weights make the same value, and sum to 1"):
    val draws = Draws(2)
    val w = new Array[Float](4)
    for _ <- 0 until 1000 do
      val x = draws.between(-1f, 2.5f)
      val first = CatmullRom.weights(nodes, x, w)
      val sum = (0 until 4).filter(w(_) != 0f).map(k => w(k) * hills(first + k)).sum
      assert(Math.abs(w.sum - 1f) < 1e-5f)
      assert(Math.abs(sum - CatmullRom.value(nodes, hills, x)) < 1e-5f)

  test("beyond the nodes there is nothing"):
    val w = new Array[Float](4)
    for x <- Seq(-1.001f, 2.501f, Float.NaN) do
      assert(CatmullRom.weights(nodes, x, w) == CatmullRom.Outside)
      assert(CatmullRom.value(nodes, hills, x) == 0f)
      assert(CatmullRom.row(nodes, hills, x).sameElements(Array(0f)))

  test("the integrals are those of the spline"):
    val sums = CatmullRom.integrals(nodes, hills)
    val steps = 100000
    val width = 3.5 / steps
    var sum = 0.0
    for i <- 0 until steps do
      sum += CatmullRom.value(nodes, hills, (-1 + (i + 0.5) * width).toFloat) * width
    // The midpoint rule is off by its step squared; the Floats of the places by more
    assert(Math.abs(sums.last - sum) < 1e-5)

  test("a sample is where the integral is its part of the whole"):
    val sums = CatmullRom.integrals(nodes, hills)
    for k <- 0 to 1000 do
      val u = Math.min(k / 1000f, OneMinusEpsilon)
      val x = CatmullRom.sample(nodes, hills, sums, u)
      val i = CatmullRom.piece(nodes, x)
      val steps = 200
      val width = (x - nodes(i)) / steps
      val within = (0 until steps)
        .map(j => CatmullRom.value(nodes, hills, nodes(i) + (j + 0.5f) * width) * width)
        .sum
      // 200 Floats are added: 200 · 6e-8
      assert(Math.abs(sums(i) + within - u * sums.last) < 2e-5f * sums.last, u)

  test("inverted, rising values give back the place"):
    val draws = Draws(3)
    for _ <- 0 until 1000 do
      val x = draws.between(-1f, 2.5f)
      val y = CatmullRom.value(nodes, rising, x)
      assert(Math.abs(CatmullRom.invert(nodes, rising, y) - x) < 1e-5f)
    assert(CatmullRom.invert(nodes, rising, -9f) == -1f)
    assert(CatmullRom.invert(nodes, rising, 9f) == 2.5f)

  test("a row of a table is each of its columns"):
    val table = nodes.flatMap(x => Array(x, x * x, 1f))
    for x <- Seq(-1f, -0.25f, 0.32f, 1.7f, 2.5f) do
      val row = CatmullRom.row(nodes, table, x)
      val squares = CatmullRom.value(nodes, values(x => x * x), x)
      for (found, right) <- row.zip(Array(x, squares, 1f)) do
        assert(Math.abs(found - right) < 2e-6f * Math.max(1f, Math.abs(right)))
