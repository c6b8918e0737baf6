package candela.caustics

import org.scalatest.funsuite.AnyFunSuite

final class CausticPilotSuite extends AnyFunSuite:
  import CausticPilot.{MinPathsPerSample, MaxPathsPerSample, amount}

  test("the number of light paths is a power of two, not above the best, within bounds"):
    val best = Vector(1e-9, 0.03, 0.25, 0.9, 1.0, 7.99, 1e9, Double.PositiveInfinity)
    assert(best.map(amount) == Vector(MinPathsPerSample, MinPathsPerSample, 0.25, 0.5, 1.0, 4.0,
      MaxPathsPerSample, MaxPathsPerSample))

  test("where nothing is found, or nothing by light paths, there are few of them"):
    assert(Vector(0.0 / 0.0, 0.0).map(amount) == Vector(MinPathsPerSample, MinPathsPerSample))
