package candela.sampling

import java.util.SplittableRandom

import org.scalatest.funsuite.AnyFunSuite

class SobolSuite extends AnyFunSuite:

  /** The second dimension by its direction numbers, one for each bit: v ← v ^ (v >>> 1). */
  private def byDirections(index: Int): Int =
    val directions = Iterator.iterate(1 << 31)(v => v ^ (v >>> 1)).take(32).toArray
    (0 until 32).filter(k => (index >>> k & 1) == 1).map(directions(_)).foldLeft(0)(_ ^ _)

  private val random = SplittableRandom(7)
  private val someInts = 0 +: -1 +: Vector.fill(2000)(random.nextInt())

  test("the second dimension is that of the direction numbers"):
    for i <- someInts do assert(Integer.reverse(Sobol.second(i)) == byDirections(i), s"index $i")

  test("its first points are those of the (0,2)-sequence"):
    val first = (0 until 8).map(i => SampleHash.toUnit(Integer.reverse(Sobol.second(i))))
    assert(first == Vector(0f, 0.5f, 0.75f, 0.25f, 0.625f, 0.125f, 0.375f, 0.875f))

  test("long and short indices give the same coarse digits"):
    for i <- someInts do
      val index = i & 0xffffffffL
      assert(Sobol.second(index).toInt == Sobol.second(i))

  test("scrambling is nested: a digit depends on itself and the coarser ones only"):
    for (v, i) <- someInts.zipWithIndex; bit <- 0 until 32 do
      val seed = SampleHash.mix(i + 1)
      val changed = Sobol.scramble(v, seed) ^ Sobol.scramble(v ^ (1 << bit), seed)
      assert(Integer.numberOfTrailingZeros(changed) == bit, s"value $v seed $seed bit $bit")

  test("each digit is flipped for about half of the seeds, whatever the coarser ones are"):
    val seeds = 4096
    for v <- Seq(0, 1, 0x2b, 0x7fffffff); bit <- 0 until 24 do
      val flips = (1 to seeds).count: s =>
        ((Sobol.scramble(v, SampleHash.mix(s)) ^ v) >>> bit & 1) == 1
      // binomial: 2048 ± 32; 5 sigmas
      assert(Math.abs(flips - seeds / 2) < 160, s"value $v bit $bit: $flips")
