package candela.cli.rendering

import candela.guiding.GuideOutcome

import org.scalatest.funsuite.AnyFunSuite

class LearningSuite extends AnyFunSuite:
  private val outcome =
    GuideOutcome(64, 120, 300, 1400, 1000L, 375L, Some(0.4156), weight = 4f, gaveUp = false)

  test("what was learnt is said in one line"):
    assert(
      Learning.summary(outcome) ==
        "guiding: learnt until sample 64; guided regions 120, of all regions 300, lobes 1400, " +
        "guided bounces 37.5 %, weight of the last samples 4, variance of the paths that were " +
        "compared, relative to unguided ones 0.416"
    )
    assert(
      Learning.summary(outcome.copy(varianceRatio = Some(1.02), gaveUp = true)) ==
        "guiding: given up at sample 64, as it did not pay: variance × 1.02"
    )

  test("too few paths for a comparison have no figure of it"):
    val keys = Learning.figures(outcome.copy(varianceRatio = None)).map(_.key)
    assert(keys == Vector("samples", "regions", "allRegions", "lobes", "share", "weight"))
    val all = Learning.figures(outcome)
    assert(all.map(_.value) == Vector(64.0, 120.0, 300.0, 1400.0, 0.375, 4.0, 0.4156))
