package candela.job

import candela.api.{Candela, RenderSettings}
import candela.cli.Captured
import candela.diagnostics.Code
import candela.image.Image
import candela.render.RenderControl
import candela.settings.BuildControl
import candela.testing.TempFolder

import java.nio.file.Files

import scala.jdk.CollectionConverters.*

import org.scalatest.funsuite.AnyFunSuite

/** Images that show nothing are told of before and after rendering, with the reason. */
class EmptyImageSuite extends AnyFunSuite:

  private def scene(
      world: String,
      look: String = "0 0 -5  0 0 0",
      film: String = ""
  ): String =
    s"""LookAt $look  0 1 0
       |Camera "perspective" "float fov" 30
       |Film "rgb" "integer xresolution" 12 "integer yresolution" 8 "string filename" "x.exr" $film
       |Sampler "halton" "integer pixelsamples" 4
       |WorldBegin
       |$world
       |""".stripMargin

  private val Sphere = "Shape \"sphere\"\n"
  private val Sun = "LightSource \"distant\" \"point3 from\" [0 0 -1] \"point3 to\" [0 0 0]\n"
  private val Sky = "LightSource \"infinite\"\n"
  private val Room = "AttributeBegin\nScale 9 9 9\nShape \"sphere\"\nAttributeEnd\n"
  private val Lamp = "LightSource \"point\" \"point3 from\" [0 3 0]\n"

  private def said(text: String, words: String*): String = saidOf(text, "x.exr", words*)

  private def saidOf(text: String, image: String, words: String*) = TempFolder.use: folder =>
    val file = Files.writeString(folder.resolve("scene.pbrt"), text)
    val out = if words.head == "check" then Nil else Seq("--outfile", s"$folder/$image")
    val (code, said) = Captured.run(words ++ Seq(file.toString) ++ out*)
    assert(code == 0, said.err)
    said.err

  private val Foreseen = Code.EmptyView.word
  private val Afterwards = Code.EmptyImage.word

  test("a camera that looks away is told by check, and once by render"):
    val text = scene(Sphere + Sun, look = "0 0 -5  0 0 -9")
    val checked = said(text, "check")
    assert(checked.contains(Foreseen) && checked.contains("looks past all surfaces"), checked)
    assert(checked.contains("scene.pbrt:2:8"), checked)
    val rendered = said(text, "render")
    assert(rendered.contains(Foreseen), rendered)
    assert(!rendered.contains(Afterwards), "one cause is told once")

  test("a camera in a closed surface is told of, with the distance and the statement"):
    val checked = said(scene(Room + Sun), "check")
    assert(
      checked.contains("inside a closed surface") && checked.contains("at distance 13"),
      checked
    )
    assert(checked.contains("scene.pbrt:8:7") && checked.contains(Foreseen), checked)
    val rendered = said(scene(Room + Sun), "render")
    assert(rendered.contains(Foreseen) && !rendered.contains(Afterwards), rendered)

  test("a surface that no light reaches is told of after rendering"):
    val wall = "Translate 0 0 -2\nShape \"disk\" \"float radius\" 50\n"
    val rendered = said(scene(Lamp + wall), "render")
    assert(!rendered.contains(Foreseen), rendered)
    assert(rendered.contains("the nearest is at distance 3"), rendered)

  test("media that no light leaves are not looked past"):
    val smoke =
      """MakeNamedMedium "smoke" "string type" "homogeneous" "rgb sigma_a" [9e4 9e4 9e4]
      |MediumInterface "smoke" ""
      |Material "interface"
      |Scale 9 9 1
      |""".stripMargin + Sphere
    val volpath = scene(Sky + smoke).replace("WorldBegin", "Integrator \"volpath\"\nWorldBegin")
    val rendered = said(volpath, "render")
    assert(rendered.contains("no light comes through the media"), rendered)
    assert(!rendered.contains("looks past"), rendered)

  test("a picture that is too dark is told of, with the exposure that shows it"):
    val faint = scene(Sphere + "LightSource \"distant\" \"rgb L\" [1e-4 1e-4 1e-4] " +
      "\"point3 from\" [0 0 -1] \"point3 to\" [0 0 0]\n")
    val dark = saidOf(faint, "x.png", "render")
    assert(dark.contains("the picture is black: its brightest value is"), dark)
    val exposure = "--exposure (\\d+) shows it".r.findFirstMatchIn(dark).get.group(1)
    for e <- Vector(exposure, "auto") do
      assert(!saidOf(faint, "x.png", "render", "--exposure", e).contains(Afterwards))
    assert(!saidOf(faint, "x.exr", "render").contains(Afterwards))

  test("rooms with a lamp, small objects and skies are not told of"):
    val far = "Translate 0.1 0.1 0\nScale .1 .1 .1\nShape \"sphere\"\n"
    for world <- Vector(Room + Lamp, Sphere + Sun, Sky, Sky + Sphere, Sun + far) do
      assert(!said(scene(world), "check").contains(Foreseen), world)
    for world <- Vector(Room + Lamp, Sphere + Sun, Sky + Sphere) do
      assert(!said(scene(world), "render").contains(Afterwards), world)

  test("an image of one colour is told of"):
    val sky = said(scene(Sky), "render")
    assert(sky.contains("all pixels have the same colour: the camera looks past all"), sky)
    val border = said(scene(Sky + "Material \"interface\"\n" + Sphere), "render")
    assert(border.contains("same colour: all that is in view is borders of media"), border)

  test("an image that the film makes negative or NaN is told of"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("scene.pbrt"), scene(Sky + Sphere))
      val settings = candela.settings.RenderSettings()
      val prepared = SceneLoader.FromFile.load(file.toString, settings, BuildControl())
      try
        val rendering = Render.render(prepared, RenderControl(threads = 1))
        val image = rendering.image(prepared.plan.development)
        def told(value: Float => Float): String =
          val data = image.data.map(value)
          val odd = Image(image.width, image.height, image.channelNames, data)
          EmptyImage.problem(prepared, rendering, odd).fold("")(_.message)
        assert(told(identity) == "")
        assert(told(-_).startsWith("all of the pixels have negative values; the light is not"))
        assert(told(_ => Float.NaN).startsWith("all of the pixels are NaN; the light is not"))
      finally prepared.close()

  test("a preview and the library tell of black images, too"):
    val text = scene(Sphere + Sun, look = "0 0 -5  0 0 -9")
    assert(said(text, "preview").contains(Afterwards))
    val read = Candela.parse(text)
    val job = read.prepare(RenderSettings())
    try
      assert(job.problems.asScala.exists(_.number == Foreseen))
      assert(job.render().problems.asScala.exists(_.number == Afterwards))
    finally job.close()
