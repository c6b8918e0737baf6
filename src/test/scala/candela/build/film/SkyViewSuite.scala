package candela.build.film

import candela.cli.Captured
import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** What the sky adds to pixels that it shows through. */
class SkyViewSuite extends AnyFunSuite:

  private def scene(integrator: String): String =
    s"""LookAt 0 0 -5  0 0 0  0 1 0
       |Camera "perspective" "float fov" 30
       |Film "rgb" "integer xresolution" 12 "integer yresolution" 12
       |Integrator $integrator
       |WorldBegin
       |LightSource "infinite" "rgb L" [1 1 1]
       |Material "diffuse" "rgb reflectance" [.7 .1 .1]
       |Shape "sphere"
       |Material "interface"
       |Shape "disk" "float height" -2 "float radius" 9
       |""".stripMargin

  private val mitsuba =
    """<scene version="3.0.0">
      |<integrator type="path"/>
      |<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
      |<sensor type="perspective"><float name="fov" value="30"/>
      |<transform name="to_world"><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform>
      |<film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="12"/>
      |<string name="pixel_format" value="rgba"/></film></sensor>
      |<shape type="sphere"/>
      |</scene>""".stripMargin

  private def image(text: String, suffix: String, words: String*): Image =
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve(s"scene.$suffix"), text)
      val out = folder.resolve("a.exr")
      val all = Seq(s"$file", "--spp", "16", "--color", "rgb", "--outfile", s"$out") ++ words
      val (code, said) = Captured.run(all*)
      assert(code == 0, said.err)
      ImageFiles.read(out)

  private def corner(image: Image): Vector[Float] =
    image.channelNames.indices.map(image(0, 0, _)).toVector

  for name <- Vector("path", "volpath", "bdpt", "simplepath", "directlighting") do
    val kind = if name == "directlighting" then "\"path\" \"integer maxdepth\" 1" else s"\"$name\""
    test(s"with alpha, colours are those of the surfaces alone: $name"):
      val found = image(scene(kind), "pbrt", "--film", "rgba")
      val Vector(g, a) = Vector("G", "A").map(found.channelNames.indexOf(_)): @unchecked
      val alphas =
        for x <- 0 until 12; y <- 0 until 12 yield (found(x, y, a), found(x, y, g))
      assert(alphas.exists((alpha, _) => alpha > 0.1f && alpha < 0.9f))
      // A convex surface in white light; the estimate varies by 16 samples of its light
      for (alpha, green) <- alphas do assert(Math.abs(green - 0.1f * alpha) < 0.06f, (alpha, green))
      assert(corner(found).forall(_ == 0f))

  test("the sky stays where it is asked for, and without alpha"):
    val path = scene("\"path\"")
    assert(corner(image(path, "pbrt", "--film", "rgba", "--sky", "show")).take(3).forall(_ > 0.9f))
    assert(corner(image(path, "pbrt")).forall(_ > 0.9f))
    val hidden = image(path, "pbrt", "--sky", "hide")
    assert(corner(hidden).forall(_ == 0f) && hidden(6, 6, 0) > 0.3f)

  test("a scene of Mitsuba with alpha has the sky, opaque, as Mitsuba does"):
    assert(corner(image(mitsuba, "xml")).forall(v => Math.abs(v - 1) < 0.02f))
    assert(corner(image(mitsuba, "xml", "--sky", "hide")).forall(_ == 0f))
