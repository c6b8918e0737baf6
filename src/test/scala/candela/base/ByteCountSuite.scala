package candela.base

import org.scalatest.funsuite.AnyFunSuite

class ByteCountSuite extends AnyFunSuite:

  test("sizes have two digits or more, and the unit that suits them"):
    val shown = Vector(0L, 999L, 1000L, 1234L, 9960L, 38_000_000L, 999_000_000L, 4_500_000_000L)
      .map(ByteCount.format)
    assert(shown ==
      Vector("0 bytes", "999 bytes", "1.0 kB", "1.2 kB", "10 kB", "38 MB", "999 MB", "4.5 GB"))

  test("thousands of GB remain GB"):
    assert(ByteCount.format(157_000_000_000_000L) == "157000 GB")
