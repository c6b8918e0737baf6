package candela.base

import org.scalatest.funsuite.AnyFunSuite

class FiguresSuite extends AnyFunSuite:

  test("metric numbers have three digits and a prefix"):
    val numbers = Vector(0.0, 950.4, 1310.0, 12_000.0, 1_314_000.0, 5.2e6, 999e6, 2.5e9)
    assert(numbers.map(Figures.metric) ==
      Vector("0", "950", "1.31 k", "12.0 k", "1.31 M", "5.20 M", "999 M", "2.50 G"))

  test("durations become coarser as they grow"):
    assert(Vector(0.0412, 0.994, 0.999, 3.21, 59.94, 59.96, 125.0, 3600.0).map(Figures.duration) ==
      Vector("0.04 s", "0.99 s", "1.0 s", "3.2 s", "59.9 s", "1:00", "2:05", "1:00:00"))

  test("clocks have hours only if there are any"):
    assert(Vector(0.2, 7.0, 83.0, 3599.4, 3725.0).map(Figures.clock) ==
      Vector("0:00", "0:07", "1:23", "59:59", "1:02:05"))

  test("one is singular"):
    assert(Vector(0L, 1L, 2L).map(Figures.count(_, "error")) ==
      Vector("0 errors", "1 error", "2 errors"))
