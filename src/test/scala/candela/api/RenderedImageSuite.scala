package candela.api

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

import scala.util.Using

final class RenderedImageSuite extends AnyFunSuite:

  test("an image without samples replaces no file, but can be a new one"):
    TempFolder.use: folder =>
      val stop = Cancellation()
      stop.cancel()
      val control = RenderControl().withThreads(1).withCancellation(stop)
      val scene = LibraryScenes.built().scene()
      val result = Using.resource(scene.prepare(RenderSettings(), 1))(_.render(control))
      assert(result.samplesPerPixel == 0)
      val file = folder.resolve("a.png")
      val _ = Files.write(file, Array[Byte](7))
      val refused = intercept[SceneException](result.image.save(file))
      assert(refused.getMessage.contains("less than 1 sample per pixel"))
      assert(Files.readAllBytes(file).toVector == Vector[Byte](7))
      result.image.save(folder.resolve("b.png"))
      assert(Files.size(folder.resolve("b.png")) > 7)
