package candela.build

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Encoding
import candela.image.{Image, ImageFiles, Samples}
import candela.mitsuba.MitsubaScene
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

final class ImageDecodingSuite extends AnyFunSuite:

  /** A file whose values are half as large as they can be. */
  private def half(file: Path): Unit =
    val data = Array.fill(3 * 8 * 8)(Encoding.Srgb.decode(0.5f))
    ImageFiles.write(file, Image(8, 8, Image.RgbNames, data))

  /** Radiance of a wall with a picture, under a sky of 1. */
  private def wall(folder: Path, name: String, raw: Boolean): Float =
    radiance(
      folder,
      name,
      "<emitter type=\"constant\"/>",
      s"""<bsdf type="diffuse"><texture name="reflectance" type="bitmap">
          <boolean name="raw" value="$raw"/><string name="filename" value="$name"/>
        </texture></bsdf>"""
    )

  /** Radiance of a wall, where a file `name` is a grey picture. */
  private def radiance(folder: Path, name: String, emitter: String, bsdf: String): Float =
    half(folder.resolve(name))
    val file = Files.writeString(
      folder.resolve("scene.xml"),
      s"""<scene version="3.0.0"><integrator type="direct"/>$emitter
        <sensor type="perspective"><float name="fov" value="20"/>
          <transform name="to_world"><lookat origin="0,0,4" target="0,0,0" up="0,1,0"/></transform>
          <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
          </film></sensor>
        <shape type="rectangle">$bsdf</shape></scene>"""
    )
    val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
    val plan = SceneBuilder.build(scene, RenderSettings())._1
    Renderer.render(plan, threads = 1).image(plan.development).data(0)

  test("raw images of Mitsuba's scenes are read as they are, JPEG as PNG"):
    Samples.inFolder: folder =>
      for name <- Vector("a.png", "a.jpg") do
        // A code of 8 bits is 1 / 255, and JPEG is off by up to two
        assert(Math.abs(wall(folder, name, raw = true) - 0.5f) < 0.01f, name)
        assert(Math.abs(wall(folder, name, raw = false) - 0.214f) < 0.01f, name)

  test("images that light Mitsuba's scenes are decoded"):
    Samples.inFolder: folder =>
      val white = "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1\"/></bsdf>"
      val file = "<string name=\"filename\" value=\"a.png\"/>"
      val sky = radiance(folder, "a.png", s"<emitter type=\"envmap\">$file</emitter>", white)
      // Undecoded it would be 0.5; a few samples are noisy
      assert(Math.abs(sky - 0.214f) < 0.05f)
      // An irradiance at distance 1, seen at 4 from there
      val place = "<transform name=\"to_world\">" +
        "<lookat origin=\"0,0,4\" target=\"0,0,0\" up=\"0,1,0\"/></transform>"
      val slide = s"<texture type=\"bitmap\" name=\"irradiance\">$file</texture>"
      val projected =
        radiance(folder, "a.png", s"<emitter type=\"projector\">$place$slide</emitter>", white)
      assert(Math.abs(projected - 0.214f / 16) < 1e-3f)

  test("normal maps of v4 are decoded unless they are PNG, as in pbrt, with a warning"):
    Samples.inFolder: folder =>
      def warnings(name: String) =
        half(folder.resolve(name))
        val scene =
          s"WorldBegin\nLightSource \"infinite\"\nMaterial \"diffuse\" \"string normalmap\" " +
            s"\"$name\"\nShape \"sphere\"\n"
        SceneTexts.problems(scene, Dialect.V4, folder).map(_.message)
      assert(warnings("a.png").isEmpty)
      assert(warnings("a.jpg").exists(_.contains("decodes this normal map as sRGB")))
