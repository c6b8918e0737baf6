package candela.film

import candela.io.CheckedFile
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class ForgedSumsSuite extends AnyFunSuite:

  /** Loads a sum with a third part. */
  private def load(at: Int, rest: String): Double =
    val file = Files.createTempFile("candela", ".sums")
    try
      CheckedFile.write(file, "sums"): out =>
        out.double(1)
        out.double(0)
        out.int(1)
        out.int(at)
        out.text(rest)
      val sums = ExactSums(1)
      CheckedFile.read(file, "sums")(sums.load)
      sums(0)
    finally Files.delete(file)

  test("numbers that no doubles leave are refused, before they fill the memory"):
    for rest <- Vector("1E+1000000000", "1E-1000000000", "1" * 3000) do
      val _ = intercept[IllegalArgumentException](load(0, rest))

  test("a third part belongs to a sum"):
    for at <- Vector(-1, 1, Int.MaxValue) do
      val _ = intercept[IllegalArgumentException](load(at, "1E-300"))

  test("what the smallest doubles leave is read"):
    val least = java.math.BigDecimal(java.lang.Double.MIN_VALUE)
    assert(load(0, least.toString) == 1)
