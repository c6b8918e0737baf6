package candela.convert

import candela.base.{loop, Problem}
import candela.build.{BuildOptions, SceneBuilder}
import candela.cli.TempFolder
import candela.image.Image
import candela.render.{ReferenceScenes, Renderer, RenderPlan}
import candela.scenefile.*
import org.scalatest.funsuite.AnyFunSuite

/** Every scene of the `scenes` folder, written in another dialect, looks the same; or the converter
  * says why not.
  */
class ConverterSuite extends AnyFunSuite:
  import ConverterSuite.*

  for
    name <- ReferenceScenes.names(ReferenceScenes.Scenes, ".pbrt") if name != "showcase"
    to <- Vector(Dialect.V3, Dialect.V4) if !name.startsWith(to.toString.toLowerCase)
  do
    test(s"$name in $to"):
      TempFolder.use: folder =>
        val scene = Parser.parse(ReferenceScenes.Scenes.resolve(s"$name.pbrt"))
        val converted = Converter.convert(scene, to, folder)
        val again = Descriptions.read(Descriptions.text(converted.scene), folder)
        assert(again.dialect == to && again.warnings.isEmpty)
        val warnings = converted.warnings.map(_.message).mkString("\n")
        assert(converted.warnings.isEmpty || !Exact((name, to)), warnings)
        assert(converted.warnings.forall(_.at.exists(_.file.endsWith(s"$name.pbrt"))))
        // Where models differ the picture differs, and that was said
        val worst = if converted.warnings.isEmpty then difference(scene, again) else 0.0
        assert(worst < 0.1, "of a quarter's mean, that noise does not explain")

object ConverterSuite:

  /** Scenes that lose nothing. */
  private val Exact: Set[(String, Dialect)] =
    val inV3 = "v2-filter-gaussian v2-filter-triangle v2-textures v4-conductor v4-depth-of-field " +
      "v4-dielectric v4-diffuse-transmission v4-environment-map v4-filter-gaussian " +
      "v4-filter-mitchell v4-lights"
    val inV4 = "v2-filter-gaussian v2-filter-triangle v2-textures v3-filter-mitchell " +
      "v3-filter-sinc v3-lights v3-meshes v3-orthographic-crop v3-quadrics v3-textures"
    (inV3.split(' ').map(_ -> Dialect.V3) ++ inV4.split(' ').map(_ -> Dialect.V4)).toSet

  private def plan(scene: SceneDescription, seed: Int): (RenderPlan, Vector[Problem]) =
    SceneBuilder.build(scene, BuildOptions(spp = Some(32), seed = seed, quick = true))

  /** Of the pictures; 0 if one of them lacks what can't be rendered yet. */
  private def difference(a: SceneDescription, b: SceneDescription): Double =
    val (before, problems) = plan(a, 1)
    val (after, others) = plan(b, 2)
    val isWhole = !(problems ++ others).exists(_.message.contains("not supported"))
    if isWhole then difference(image(before), image(after), 2) else 0.0

  private def image(plan: RenderPlan): Image =
    Renderer.render(plan, 2).image(plan.development)

  /** The largest relative difference of the means of `parts` × `parts` blocks, in any channel;
    * what is darker than a tenth of the image counts as that bright.
    */
  private def difference(a: Image, b: Image, parts: Int): Double =
    val (x, y) = (blocks(a, parts), blocks(b, parts))
    val least = 0.1 * x.sum / x.length
    x.indices.map(i => Math.abs(x(i) - y(i)) / Math.max(x(i), least)).max

  private def blocks(image: Image, parts: Int): Array[Double] =
    val sums = new Array[Double](parts * parts * 3)
    val counts = new Array[Int](parts * parts * 3)
    loop(image.height): y =>
      loop(image.width): x =>
        val block = y * parts / image.height * parts + x * parts / image.width
        loop(3): c =>
          sums(block * 3 + c) += image(x, y, c)
          counts(block * 3 + c) += 1
    sums.indices.map(i => sums(i) / counts(i)).toArray
