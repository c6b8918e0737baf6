package candela.sampling

/** Pseudorandom permutations of 0 until `n`, computed element by element: nothing is stored. */
object Permutation:

  /** Image of `index` under the permutation selected by `seed`; 0 ≤ `index` < `n`.
    *
    * Cycle-walks a bijection of the next power of two until the result is below `n`: less than half
    * of its elements are outside, so this takes fewer than two steps on average. Each round adds,
    * multiplies by an odd number and folds the upper half onto the lower one, all of which are
    * invertible.
    *
    * Source of the idea: Kensler, "Correlated multi-jittered sampling", Pixar TM 13-01, 2013, §3.
    */
  def element(index: Int, n: Int, seed: Long): Int =
    if n <= 1 then 0
    else
      val bits = 32 - Integer.numberOfLeadingZeros(n - 1)
      val mask = -1 >>> (32 - bits)
      val fold = (bits + 1) / 2
      var permuted = index
      while
        var keys = seed
        var round = 0
        while round < Rounds do
          keys = keys * 0xd1342543de82ef95L + SampleHash.Step
          val key = (keys >>> 32).toInt
          permuted = ((permuted + (key >>> 16)) * (key | 1)) & mask
          permuted ^= permuted >>> fold
          round += 1
        permuted >= n
      do ()
      permuted

  /** Enough to distribute pairs of elements uniformly; `PermutationSuite` rejects 5. */
  private inline val Rounds = 10
