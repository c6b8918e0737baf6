package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.ChiSquare

class PermutationSuite extends AnyFunSuite:

  test("every seed gives a permutation, for every size"):
    for n <- (1 to 40) ++ Seq(64, 100, 255, 256, 257, 1000); seed <- 0 until 10 do
      val image = (0 until n).map(Permutation.element(_, n, SampleHash.mix64(seed)))
      assert(image.sorted == (0 until n), s"n=$n seed=$seed")

  test("pairs of elements land on all pairs of places equally often"):
    val sizes = Seq(2, 3, 4, 5, 8, 9, 16, 25)
    val draws = 60000
    for n <- sizes do
      val observed = new Array[Long](n * n)
      for s <- 1 to draws do
        val seed = SampleHash.mix64(s)
        val (i, j) = (0, n - 1)
        observed(Permutation.element(i, n, seed) * n + Permutation.element(j, n, seed)) += 1
      val expected = Array.tabulate(n * n): k =>
        if k / n == k % n then 0.0 else draws.toDouble / (n * (n - 1))
      val result = ChiSquare.counts(observed, expected)
      assert(result.accepted(sizes.size), s"n=$n: $result")

  test("neighbours land on all pairs of places equally often"):
    val n = 16
    val draws = 60000
    for i <- Seq(0, 5, 14) do
      val observed = new Array[Long](n * n)
      for s <- 1 to draws do
        val seed = SampleHash.mix64(s + 1000000)
        observed(Permutation.element(i, n, seed) * n + Permutation.element(i + 1, n, seed)) += 1
      val expected = Array.tabulate(n * n): k =>
        if k / n == k % n then 0.0 else draws.toDouble / (n * (n - 1))
      val result = ChiSquare.counts(observed, expected)
      assert(result.accepted(tests = 3), s"i=$i: $result")
