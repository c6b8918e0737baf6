package candela.bench.statistics

import candela.measure.Interval
import org.scalatest.funsuite.AnyFunSuite

import java.util.SplittableRandom

class ErrorIntervalSuite extends AnyFunSuite:

  private val trials = 1000

  // Four deviations of a binomial count of 1000 at 95 %, in per cent
  private val noise = 2.8

  /** Coverage in per cent, and how many in a hundred have no upper limit.
    *
    * @param image one image's parts
    * @param truth the expectation of their sum
    */
  private def coverage(seeds: Int, truth: Double)(image: () => Array[Double]): (Double, Double) =
    val all = Vector.fill(trials)(ErrorInterval.of(Vector.fill(seeds)(image())).interval)
    val bounded = all.filter(_.isBounded)
    val hits = bounded.count(i => i.low <= truth && truth <= i.high)
    (100.0 * hits / Math.max(1, bounded.size), 100 - 100.0 * bounded.size / trials)

  test("intervals hold the expected error in 93 to 97 % of cases where parts are independent"):
    val random = SplittableRandom(1)
    for seeds <- Vector(2, 3, 10) do
      // Each part is the square of a normal number: its mean is 1.
      val (hits, open) = coverage(seeds, 40)(() => Array.fill(40)(square(normal(random))))
      assert(hits > 93 - noise && hits < 97 + noise, s"$seeds seeds: $hits")
      assert(open == 0, s"$seeds seeds")

  test("intervals hold the expected error where seeds, not pixels, are good or bad"):
    val random = SplittableRandom(2)
    for seeds <- Vector(3, 10) do
      val (hits, _) = coverage(seeds, 40): () =>
        val good = 1 + 0.3 * normal(random)
        Array.fill(40)(good * square(normal(random)) * 0.1 + 0.9 * good)
      assert(hits > 93 - noise && hits < 98 + noise, s"$seeds seeds: $hits")

  test("an error that hangs on a few events has a lower limit and no upper one"):
    val random = SplittableRandom(3)
    def image() = Array.fill(200)(if random.nextInt(100) == 0 then 1.0 else 1e-4)
    val all = Vector.fill(trials)(ErrorInterval.of(Vector.fill(3)(image())).interval)
    // Six events in all three are expected: twelve or more, or none, are so in 2 % of cases
    assert(all.count(!_.isBounded) > 0.95 * trials)
    assert(all.count(_.low <= 2.02) > 0.95 * trials)

  test("equal images have an empty interval, one image none"):
    val parts = Array(1.0, 2.0)
    assert(ErrorInterval.of(Vector(parts, parts)).interval == Interval(3, 3, 3))
    assert(!ErrorInterval.of(Vector(parts)).interval.isKnown)

  private def square(a: Double) = a * a

  private def normal(random: SplittableRandom): Double =
    Vector.fill(12)(random.nextDouble()).sum - 6
