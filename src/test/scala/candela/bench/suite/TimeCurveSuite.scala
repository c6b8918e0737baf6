package candela.bench.suite

import org.scalatest.funsuite.AnyFunSuite

class TimeCurveSuite extends AnyFunSuite:

  /** Trials for this budget of a program that takes `seconds`, and what it takes for the budget. */
  private def filled(budget: Double)(seconds: Int => Double): (Vector[Int], Double) =
    val curve = TimeCurve.measured(budget)(n => Some(seconds(n))).get
    (curve.points.map(_._1), seconds(curve.samplesIn(budget)))

  test("a time is filled with as many samples as fit into it, and one at least"):
    // Half a second to start, a tenth for each sample
    val curve = TimeCurve(Vector(1 -> 0.6, 8 -> 1.3))
    assert(curve.samplesIn(2.65) == 21)
    assert(curve.samplesIn(0.1) == 1)
    assert(TimeCurve(Vector(1 -> 20.0)).samplesIn(60) == 3)

  test("a program that compiles first gets its time, if that is long enough to see the end of it"):
    def seconds(n: Int) = 0.5 + 0.01 * n + 2 * (1 - Math.exp(-n / 10.0))
    for budget <- Seq(8.0, 20.0, 60.0) do
      val (trials, taken) = filled(budget)(seconds)
      // Linear from trials of less than half the budget, past most of what is compiled
      assert(Math.abs(taken / budget - 1) < 0.05, s"$budget s: $trials, $taken s")

  test("trials take no longer together than the budget"):
    for each <- Seq(1e-3, 0.01, 0.1, 1.0); start <- Seq(0.0, 0.5) do
      val (trials, taken) = filled(20)(n => start + each * n)
      // Whole samples: of 1 s, a twentieth of the budget
      assert(Math.abs(taken / 20 - 1) < 0.06, s"$trials, $taken s")
      assert(trials.map(n => start + each * n).sum <= 20, s"$trials")

  test("a first image that takes longer than the next ones misleads nobody"):
    // A cache on disk is filled by the first run
    var runs = 0
    def seconds(n: Int) =
      runs += 1
      if runs == 1 then 3.0 else 0.4 + 0.02 * n
    val (trials, taken) = filled(10)(seconds)
    assert(Math.abs(taken / 10 - 1) < 0.05, s"$trials, $taken s")

  test("between trials the time is linear"):
    val curve = TimeCurve(Vector(1 -> 1.0, 8 -> 2.0, 32 -> 3.0))
    assert(curve.samplesIn(2.5) == 20)
    assert(curve.samplesIn(1.5) == 4)

  test("longer renderings than the trials count as well, the latest of as many samples instead"):
    // After 20 samples each takes four times as long
    val trials = TimeCurve(Vector(1 -> 0.1, 8 -> 0.8, 16 -> 1.6))
    assert(trials.samplesIn(4.0) == 40)
    val later = trials.and(40, 10.0)
    assert(later.samplesIn(4.0) == 22)
    assert(later.and(40, 8.0).samplesIn(4.0) == 25)
    assert(later.and(12, 1.3).points.map(_._1) == Vector(1, 8, 12, 16, 40))

  test("a tenth of a budget is as good as equal"):
    assert(!TimeCurve.isFar(9.1, 10) && !TimeCurve.isFar(10.9, 10))
    assert(TimeCurve.isFar(8.9, 10) && TimeCurve.isFar(11.1, 10))

  test("a trial that fails leaves no curve"):
    assert(TimeCurve.measured(10)(n => Option.when(n < 8)(0.1)).isEmpty)
