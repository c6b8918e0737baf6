package candela.media

import org.scalatest.funsuite.AnyFunSuite

class PathWeightsSuite extends AnyFunSuite:

  test("a path that keeps its hero alone keeps the sums of all colours' densities"):
    val weights = PathWeights()
    weights.start(1, lightRatio = 2f)
    weights.r = 0.5f
    weights.ur = 1f
    weights.ug = 2f
    weights.ub = 4f
    weights.lr = 3f
    weights.lg = 5f
    weights.lb = 7f
    val light = weights.lightRatio
    weights.keepHero()
    assert(weights.isAlone && weights.hero == 0)
    assert((weights.r, weights.g, weights.b) == (1.5f, 0f, 0f))
    assert((weights.ur, weights.ug, weights.ub) == (7f, 0f, 0f))
    assert((weights.lr, weights.lg, weights.lb) == (15f, 0f, 0f))
    assert(weights.lightRatio == light)
