package candela.stability

import org.scalatest.funsuite.AnyFunSuite

import candela.build.SceneBuilder
import candela.image.Image
import candela.render.Renderer
import candela.scenefile.{Dialect, Parser}
import candela.settings.RenderSettings

/** The scenes that other programs are compared with, of a quarter of the pixels. */
class HardScenesSuite extends AnyFunSuite:

  private def render(name: String): Image =
    val text =
      HardScene(name, "", Expected.Value(0)).text.replace("resolution\" 64", "resolution\" 32")
    val scene = Parser.parseText(s"$name.pbrt", text, HardScenes.Folder, Some(Dialect.V3))
    val (plan, problems) = SceneBuilder.build(scene, RenderSettings())
    assert(problems.isEmpty)
    Renderer.render(plan, threads = 2).image(plan.development)

  private lazy val onSmallPlane = render(HardScenes.OnSmallPlane)

  for scene <- HardScenes.all do
    test(s"${scene.name}: ${scene.words}"):
      val image = render(scene.name)
      val right = scene.right(image, _ => Some(onSmallPlane)).get
      val verdict = Verdict.of(scene, image, right)
      assert(verdict.isCorrect, verdict.figures)
