package candela.models

import candela.base.loop
import candela.build.SceneBuilder
import candela.image.{Image, ImageFiles}
import candela.io.SceneFolder
import candela.render.Renderer
import candela.scenefile.Resolution
import candela.settings.{ReadSettings, RenderSettings}

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Models of `scenes/models` against Cycles' images of them; see `reference-images/README.md`. */
class GltfReferenceSuite extends AnyFunSuite, GltfModels:
  private val Block = 10

  private def rendered(name: String, size: Resolution): Image =
    val file = Path.of("scenes", "models", s"$name.gltf")
    val reading = ReadSettings(resolution = Some(size))
    val scene = format.read(file, SceneFolder.of(file), reading, None)
    assert(scene.errors.isEmpty && scene.warnings.isEmpty, scene.errors ++ scene.warnings)
    val settings = RenderSettings(samples = Some(64), reading = reading)
    val (plan, _) = SceneBuilder.build(scene, settings)
    Renderer.render(plan, 1).image(plan.development).toRgb

  /** Means of blocks of pixels, by channel. */
  private def blocks(image: Image): Vector[Float] =
    val (columns, rows) = (image.width / Block, image.height / Block)
    val sums = new Array[Float](3 * columns * rows)
    loop(image.height): y =>
      loop(image.width): x =>
        loop(3): c =>
          val i = 3 * (y / Block * columns + x / Block) + c
          sums(i) += image.data(3 * (y * image.width + x) + c) / (Block * Block)
    sums.toVector

  test("shapes, materials, images and lights are those of Cycles", Slow):
    val expected = ImageFiles.read(Path.of("reference-images", "models", "gl-shapes.exr")).toRgb
    val image = rendered("gl-shapes", Resolution.Size(expected.width, expected.height))
    val (ours, cycles) = (blocks(image), blocks(expected))
    // Noise of 64 samples
    for (a, b) <- ours.zip(cycles) do assert(Math.abs(a - b) <= 0.01f * b + 0.003f, s"$a, not $b")
    val (sum, reference) = (ours.sum, cycles.sum)
    assert(Math.abs(sum / reference - 1f) < 0.002f, s"$sum, not $reference")
