package candela.build.lights

import candela.build.recipe.{Findings, Resources, Site}
import candela.color.ColorBasis
import candela.image.{Image, ImageFiles}
import candela.lights.PictureLookup
import candela.scenefile.Dialect
import candela.testing.{SceneTexts, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

final class LightImagesSuite extends AnyFunSuite:
  test("lights with one image share it, those of another basis or lookup do not"):
    TempFolder.use: folder =>
      val file = folder.resolve("shades.pfm")
      ImageFiles.write(file, Image(2, 2, Image.RgbNames, Array.tabulate(12)(_ / 12f)))
      val light = s"LightSource \"projection\" \"string filename\" \"$file\"\n"
      val statements = SceneTexts.parse(s"WorldBegin\n$light$light", Dialect.V4).lights.map(_.light)
      val resources = Resources(ColorBasis.Srgb)
      def picture(k: Int, lookup: PictureLookup, resources: Resources) =
        val site = Site(statements(k), Dialect.V4, resources, Findings())
        LightImages.picture("filename", lookup)(using site).get
      val first = picture(0, PictureLookup.Nearest, resources)
      assert(picture(1, PictureLookup.Nearest, resources) eq first)
      assert(picture(1, PictureLookup.Smooth, resources) ne first)
      val sharp = resources.in(ColorBasis.Sharp)
      assert(picture(1, PictureLookup.Nearest, sharp) ne first)
      assert(first.meanOfMax > 0.3f)
