package candela.film

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Random

class FilterSamplerSuite extends AnyFunSuite:

  private val n = 512

  private val functions = Vector[(String, (Double, Double) => Double)](
    "1" -> ((_, _) => 1.0),
    "x + 2y" -> ((x, y) => x + 2 * y),
    "x² + xy" -> ((x, y) => x * x + x * y),
    "cos 3x · cos y" -> ((x, y) => Math.cos(3 * x) * Math.cos(y)),
    "exp((x − y)/2)" -> ((x, y) => Math.exp((x - y) / 2))
  )

  /** The mean of weight · f for each function, over n × n jittered samples. */
  private def estimates(filter: Filter): Vector[Double] =
    val sampler = FilterSampler(filter)
    val random = Random(1)
    val sums = new Array[Double](functions.size)
    for i <- 0 until n; j <- 0 until n do
      sampler.sample((i + random.nextFloat()) / n, (j + random.nextFloat()) / n)
      for k <- sums.indices do
        sums(k) += sampler.weight * functions(k)(1)(sampler.dx, sampler.dy)
    sums.map(_ / (n.toDouble * n)).toVector

  /** ∫ filter · f / ∫ filter by the midpoint rule, which shares nothing with the sampler. */
  private def integrals(filter: Filter): Vector[Double] =
    val sums = new Array[Double](functions.size)
    var norm = 0.0
    for i <- 0 until n; j <- 0 until n do
      val dx = ((i + 0.5) / n * 2 - 1) * filter.radiusX
      val dy = ((j + 0.5) / n * 2 - 1) * filter.radiusY
      val value = filter(dx.toFloat, dy.toFloat)
      for k <- sums.indices do sums(k) += value * functions(k)(1)(dx, dy)
      norm += value
    sums.map(_ / norm).toVector

  for (name, filter) <- FiltersSuite.all do
    test(s"$name: weighted means reproduce the filter's integrals"):
      val results = estimates(filter).zip(integrals(filter))
      for ((label, _), (found, wanted)) <- functions.zip(results) do
        // Five standard deviations of a jittered mean: 5 · range · n^(−3/2), the range of weight ·
        // f being at most 20 here; the midpoint rule's error is smaller.
        val tolerance = 5 * 20 * Math.pow(n, -1.5)
        assert(Math.abs(found - wanted) < tolerance, s"$label: $found $wanted")

    test(s"$name: samples stay within the radii, with weights of the filter's sign"):
      val sampler = FilterSampler(filter)
      val ends = Vector(0f, 1e-7f, 0.25f, 0.5f, 0.75f, Math.nextDown(1f))
      for u1 <- ends ++ (0 until 97).map(_ / 97f); u2 <- ends do
        sampler.sample(u1, u2)
        assert(Math.abs(sampler.dx) <= filter.radiusX && Math.abs(sampler.dy) <= filter.radiusY)
        assert(java.lang.Float.isFinite(sampler.weight))
        val sign = Math.signum(filter.x(sampler.dx)) * Math.signum(filter.y(sampler.dy))
        assert(sampler.weight == 0f || Math.signum(sampler.weight) == sign, s"$u1 $u2")

  test("samples of box, triangle and Gaussian count the same"):
    val positive = Set("box", "wide box", "triangle", "Gaussian", "wide Gaussian")
    for (name, filter) <- FiltersSuite.all if positive(name) do
      // Exact density for the first three; a Gaussian's curvature within 1/32 pixel for the others.
      val tolerance = if name.contains("Gauss") then 0.01f else 1e-4f
      val sampler = FilterSampler(filter)
      for i <- 0 until 50; j <- 0 until 50 do
        sampler.sample((i + 0.5f) / 50, (j + 0.5f) / 50)
        assert(Math.abs(sampler.weight - 1f) < tolerance, s"$name at ${sampler.dx}, ${sampler.dy}")

  test("a box sample moves with its number, and copies are independent"):
    val sampler = FilterSampler(BoxFilter(0.5f, 0.25f))
    val copy = sampler.copy()
    sampler.sample(0.25f, 0.75f)
    copy.sample(0.5f, 0.5f)
    assert(Math.abs(sampler.dx + 0.25f) < 1e-6f && Math.abs(sampler.dy - 0.125f) < 1e-6f)
    assert(Math.abs(copy.dx) < 1e-6f && Math.abs(copy.dy) < 1e-6f)
