package candela.integrators

import candela.sampling.{HaltonSampler, IndependentSampler, OwenSobolSampler, Sampler}

import org.scalatest.funsuite.AnyFunSuite

final class BranchPointsSuite extends AnyFunSuite:
  import BranchPointsSuite.*

  for average <- Vector(0.5f, 0.7f, 1f, 1.6f, 2f, 4.3f, 8f) do
    test(s"$average branches on average are spread evenly"):
      // Cells of each side of the unit square
      for (sampler, error) <- Vector((OwenSobolSampler(Samples, 5), 0.1), (independent, 0.25)) do
        val counts = Array.ofDim[Int](Cells, Cells)
        for (x, y) <- directions(sampler, average) do
          counts((x * Cells).toInt)((y * Cells).toInt) += 1
        val perCell = Samples * average / (Cells * Cells)
        val worst = counts.flatten.map(n => Math.abs(n / perCell - 1)).max
        // Independent points show that cells are small enough to tell
        if sampler eq independent then
          assert(worst < error * Math.sqrt(4 / average) && worst > 0.02)
        else assert(worst < error, worst)
        assert(Math.abs(counts.flatten.sum / (Samples * average) - 1) < 0.05)

  test("what follows has the same dimensions, however many branches there are"):
    for sampler <- Vector(independent, OwenSobolSampler(16, 5), HaltonSampler(16, 5)) do
      def after(average: Float) =
        sampler.start(3, 4, 7)
        BranchPoints().draw(average, chooses = true, sampler)
        sampler.next1D()
      assert(Vector(0.5f, 1.5f, 7.5f).map(after).distinct == Vector(after(1f)))

  test("each branch has dimensions of its own, the same in all samples"):
    def numbers(sample: Int, average: Float): Vector[Long] =
      val points = BranchPoints()
      independent.start(3, 4, sample)
      points.draw(average, chooses = true, independent)
      Vector.tabulate(points.count)(points.position)
    val all = numbers(sample = 1, average = 8f)
    assert(all.size == 8 && all.distinct == all)
    assert(numbers(sample = 2, average = 8f) == all)
    assert(numbers(sample = 2, average = 3f) == all.take(3))

private object BranchPointsSuite:
  private inline val Samples = 1 << 12
  private inline val Cells = 8

  private val independent = IndependentSampler(Samples, 5)

  /** Points of all branches that leave a vertex in all samples of a pixel. */
  private def directions(sampler: Sampler, average: Float): Vector[(Float, Float)] =
    val points = BranchPoints()
    for
      sample <- Vector.range(0, Samples)
      branch <-
        sampler.start(3, 4, sample)
        points.draw(average, chooses = true, sampler)
        Vector.range(0, points.count)
    yield (points.x(branch), points.y(branch))
