package candela.lights

import candela.color.Rgb
import candela.image.{Image, ImageFiles}
import candela.scenefile.Dialect
import candela.testing.{SceneTexts, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

final class SharedPicturesSuite extends AnyFunSuite:
  test("area lights with one image share it"):
    TempFolder.use: folder =>
      val file = folder.resolve("shades.pfm")
      ImageFiles.write(file, Image(2, 2, Image.RgbNames, Array.tabulate(12)(_ / 12f)))
      def lamp(scale: Int) =
        s"""AttributeBegin
           |AreaLightSource "diffuse" "string filename" "$file" "float scale" $scale
           |Shape "sphere" "float radius" 0.$scale
           |AttributeEnd
           |""".stripMargin
      val text = "Camera \"perspective\"\nWorldBegin\n" + (1 to 3).map(lamp).mkString
      val pictures = SceneTexts.plan(text, Dialect.V4).scene.lights.collect:
        case light: PictureLight => light.picture
      assert(pictures.length == 3 && pictures.forall(_ eq pictures(0)))
      assert(pictures(0).meanOfMax > 0.3f)
