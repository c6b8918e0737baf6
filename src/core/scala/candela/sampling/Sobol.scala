package candela.sampling

/** The Sobol' (0,2)-sequence and its Owen scrambling, on bit-reversed numbers: bit 0 has weight
  * 1/2, bit 1 has weight 1/4, and so on. In this order the first dimension of point `i` is `i`
  * itself, and carries of integer arithmetic run from coarse to fine digits as Owen's nested
  * scrambling requires. `Integer.reverse` turns the result into a fixed-point fraction.
  *
  * Sources: Sobol', "On the distribution of points in a cube and the approximate evaluation of
  * integrals", 1967; Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020.
  */
object Sobol:

  /** The second dimension of point `index`, bit-reversed.
    *
    * Its generator matrix is Pascal's triangle modulo 2. C(k, j) is odd exactly if the bits of j
    * are among those of k (Lucas), so bit j of the product is the parity of all bits k ⊇ j: a
    * subset sum, computed in one step for each of the five bits of a bit's number.
    */
  def second(index: Int): Int =
    var v = index
    v ^= (v >>> 1) & 0x55555555
    v ^= (v >>> 2) & 0x33333333
    v ^= (v >>> 4) & 0x0f0f0f0f
    v ^= (v >>> 8) & 0x00ff00ff
    v ^ (v >>> 16)

  /** [[second]] for indices past 2³²; the lower half of the result holds the coarser digits. */
  def second(index: Long): Long =
    var v = index
    v ^= (v >>> 1) & 0x5555555555555555L
    v ^= (v >>> 2) & 0x3333333333333333L
    v ^= (v >>> 4) & 0x0f0f0f0f0f0f0f0fL
    v ^= (v >>> 8) & 0x00ff00ff00ff00ffL
    v ^= (v >>> 16) & 0x0000ffff0000ffffL
    v ^ (v >>> 32)

  /** Hash-based nested uniform (Owen) scrambling: bit k of the result is bit k of `reversed`,
    * flipped or not depending on the bits below k and on `seed`.
    *
    * Source: Laine & Karras, "Stratified sampling for stochastic transparency", EGSR 2011; the
    * constants, which avalanche better, of Vegdahl, "Building a better LK hash", psychopath.io,
    * 2021.
    */
  def scramble(reversed: Int, seed: Int): Int =
    var v = reversed
    v ^= v * 0x3d20adea
    v += seed
    v *= (seed >>> 16) | 1
    v ^= v * 0x05526c56
    v ^ (v * 0x53a22864)
