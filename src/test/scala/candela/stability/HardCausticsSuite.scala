package candela.stability

import candela.caustics.CausticTracerSuite
import candela.image.Image
import candela.integrators.CausticsMode
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{BlockMeans, SceneTexts}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Caustics where arithmetic is hard: light paths and photons. */
final class HardCausticsSuite extends AnyFunSuite:

  private def image(text: String, mode: CausticsMode, spp: Int, seed: Int = 0): Image =
    val settings = RenderSettings(Some(spp), seed, color = ColorMode.Rgb, caustics = Some(mode))
    val plan = SceneTexts.plan(text, Dialect.V4, settings)
    val rendering = Renderer.render(plan, threads = 2)
    assert(rendering.discarded.isEmpty, s"$mode")
    rendering.image(plan.development)

  for (what, scene) <- CausticTracerSuite.Hard do
    val text = scene
      .replace("xresolution\" 48", "xresolution\" 32")
      .replace("yresolution\" 32", "yresolution\" 16")

    test(s"a point light shines through it, and every pixel is a number: $what"):
      val point = """LightSource "point" "rgb I" [2 2 2] "point3 from" [-.3 1.6 -.2]"""
      val lit = text.replace("WorldBegin", s"WorldBegin $point")
      for mode <- Seq(CausticsMode.On, CausticsMode.Photons) do
        assert(image(lit, mode, 3).data.forall(v => v >= 0f && v < 1e4f), mode)

    test(s"neither the pilot's choice nor photons change the mean: $what", Slow):
      val expected = image(text, CausticsMode.Off, 96, seed = 1)
      for mode <- Seq(CausticsMode.Auto, CausticsMode.Photons) do
        // Photons near an edge are gathered beyond it, too
        BlockMeans.assertEqual(image(text, mode, 32), expected, clue = s"$mode", allowance = 0.04)
