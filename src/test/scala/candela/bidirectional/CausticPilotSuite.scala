package candela.bidirectional

import candela.integrators.CausticsMode
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

final class CausticPilotSuite extends AnyFunSuite:
  import CausticPilot.{MinPathsPerSample, MaxPathsPerSample, amount}

  test("the number of light paths is a power of two, not above the best, within bounds"):
    val best = Vector(1e-9, 0.03, 0.25, 0.9, 1.0, 7.99, 1e9, Double.PositiveInfinity)
    assert(best.map(amount) == Vector(MinPathsPerSample, MinPathsPerSample, 0.25, 0.5, 1.0, 4.0,
      MaxPathsPerSample, MaxPathsPerSample))

  test("where nothing is found, or nothing by light paths, there are few of them"):
    assert(Vector(0.0 / 0.0, 0.0).map(amount) == Vector(MinPathsPerSample, MinPathsPerSample))

  test("beside manifold walks light paths are not as few as they may be"):
    val point = """LightSource "point" "rgb I" [9 9 9] "point3 from" [1 3 0]"""
    val text = CausticTracerSuite
      .scene(CausticTracerSuite.GlassBall, point)
      .replace("LookAt 0 2 -4  0 .4 0", "LookAt 0 2 -4  0 9 -9")
    val settings = RenderSettings(Some(1), caustics = Some(CausticsMode.On))
    val told = SceneTexts.plan(text, Dialect.V4, settings).features.toMap.apply("caustics")
    assert(told.contains("manifold walks look for the light, and 0.125 light paths"), told)
