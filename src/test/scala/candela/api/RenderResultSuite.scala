package candela.api

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Using

final class RenderResultSuite extends AnyFunSuite:

  test("an error is known from eight samples on, also that of a complete film"):
    TempFolder.use: folder =>
      for samples <- Vector(2, 7, 8) do
        val control = RenderControl().withThreads(1).withErrorEstimates
          .withFilm(folder.resolve(s"$samples.film"))
        def known() =
          val scene = LibraryScenes.built(samples).scene()
          val result = Using.resource(scene.prepare(RenderSettings(), 1))(_.render(control))
          assert(result.samplesPerPixel == samples)
          result.error.isPresent
        assert(known() == (samples >= 8) && known() == (samples >= 8), samples)
