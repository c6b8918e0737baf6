package candela.bsdf

/** Pearson's test of counts against expectations. */
object ChiSquare:

  /** The probability that counts as far from `expected` or farther come about by chance.
    *
    * Cells that expect fewer than 5 are pooled, as the test's approximation asks (Cochran, "Some Methods
    * for Strengthening the Common χ² Tests", Biometrics 10, 1954).
    */
  def pValue(observed: Array[Int], expected: Array[Double]): Double =
    var statistic = 0.0
    var cells = 0
    var pooledObserved, pooledExpected = 0.0
    def count(o: Double, e: Double): Unit =
      statistic += (o - e) * (o - e) / e
      cells += 1
    for (o, e) <- observed.zip(expected) do
      if e < 5 then
        pooledObserved += o
        pooledExpected += e
      else count(o, e)
    if pooledExpected >= 5 then count(pooledObserved, pooledExpected)
    // What is expected (almost) never may not happen often; 20 is beyond chance by far.
    else if pooledObserved > pooledExpected + 20 then return 0.0
    if cells < 2 then 1.0 else upperTail(statistic, cells - 1)

  /** Source: Wilson and Hilferty, "The distribution of chi-square", PNAS 17, 1931: a cube root is
    * nearly normal.
    */
  private def upperTail(statistic: Double, freedom: Int): Double =
    val spread = 2.0 / (9.0 * freedom)
    val z = (Math.cbrt(statistic / freedom) - (1 - spread)) / Math.sqrt(spread)
    0.5 * erfc(z / Math.sqrt(2))

  /** Source: Abramowitz and Stegun, 7.1.26; off by at most 1.5e-7. */
  private def erfc(x: Double): Double =
    val t = 1 / (1 + 0.3275911 * Math.abs(x))
    val series = ((((1.061405429 * t - 1.453152027) * t + 1.421413741) * t - 0.284496736) * t +
      0.254829592) * t
    val tail = series * Math.exp(-x * x)
    if x >= 0 then tail else 2 - tail
