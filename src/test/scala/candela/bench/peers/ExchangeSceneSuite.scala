package candela.bench.peers

import candela.concurrency.Parallel
import candela.image.{Image, ImageFiles}
import candela.job.{Render, SceneLoader}
import candela.render.RenderControl
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class ExchangeSceneSuite extends AnyFunSuite:

  private val view =
    """LookAt 0 1.2 -4  0 .4 0  0 1 0
      |Camera "perspective" "float fov" 34
      |Sampler "independent" "integer pixelsamples" 64
      |PixelFilter "box" "float xradius" .5 "float yradius" .5
      |Film "rgb" "integer xresolution" 20 "integer yresolution" 16 "string filename" "x.exr"
      |Integrator "path" "integer maxdepth" 3
      |WorldBegin
      |""".stripMargin

  /** Grey, so that numbers and spectra agree; each part from another branch of the writer. */
  private val world =
    """LightSource "infinite" "rgb L" [.4 .4 .4]
      |LightSource "point" "point3 from" [1 3 -1] "rgb I" [3 3 3]
      |LightSource "distant" "point3 from" [-1 2 -1] "rgb L" [.5 .5 .5]
      |AttributeBegin
      |  AreaLightSource "diffuse" "rgb L" [2 2 2] "float scale" 3
      |  Material "diffuse" "rgb reflectance" [0 0 0]
      |  Translate -1 1.6 0
      |  ReverseOrientation
      |  Shape "trianglemesh" "integer indices" [0 2 1] "point3 P" [-.4 0 -.4  .4 0 -.4  0 0 .6]
      |AttributeEnd
      |Texture "checks" "spectrum" "imagemap" "string filename" "checks.png" "float uscale" 2
      |Material "diffuse" "texture reflectance" "checks"
      |Shape "bilinearmesh" "point3 P" [-2 0 -2  2 0 -2  -2 0 2  2 0 2]
      |  "point2 uv" [0 0  1 0  0 1  1 1]
      |AttributeBegin
      |  Material "dielectric" "float eta" 1.5
      |  Translate .7 .4 0
      |  Shape "sphere" "float radius" .4
      |AttributeEnd
      |AttributeBegin
      |  Material "conductor" "rgb eta" [1.5 1.5 1.5] "rgb k" [4 4 4]
      |  Translate -.6 .4 .2
      |  Scale -1 .8 1
      |  Shape "sphere" "float radius" .4
      |AttributeEnd
      |""".stripMargin

  private def written(folder: Path, text: String): PeerFiles =
    val checks = Image.rgb(4, 4)
    for i <- 0 until 16; c <- 0 until 3 do
      checks.data(3 * i + c) = if i < 5 then 0.8f else 0.2f + 0.02f * i
    ImageFiles.write(folder.resolve("checks.png"), checks)
    val file = Files.writeString(folder.resolve("a.pbrt"), text)
    PeerScenes.of(file, folder.resolve("out"))

  private def rendered(file: Path): Image =
    val loaded = SceneLoader.FromFile.load(file.toString, RenderSettings(), BuildControl())
    try Render.render(loaded, RenderControl()).image(loaded.plan.development, Parallel.Alone)
    finally loaded.close()

  test("Candela renders what it writes for other programs as it renders the scene"):
    TempFolder.use: folder =>
      val made = written(folder, view + world)
      assert(made.files.contains(PeerScenes.Exchange), made.failures)
      val own = rendered(made.files("v4")).toRgb
      val other = rendered(made.files(PeerScenes.Exchange)).toRgb
      def mean(i: Image, from: Int, until: Int) =
        val values = for y <- from until until; x <- 0 until 20 yield i(x, y, 1).toDouble
        values.sum / values.size
      // 64 samples: means of 80 pixels have noise of 1 %
      for j <- 0 until 4 do
        val (a, b) = (mean(own, 4 * j, 4 * j + 4), mean(other, 4 * j, 4 * j + 4))
        assert(Math.abs(a / b - 1) < 0.04, s"rows from ${4 * j}: $a, $b")

  test("what the programs do not share is named"):
    TempFolder.use: folder =>
      val coat = "Material \"coateddiffuse\"\nShape \"loopsubdiv\" \"integer indices\" [0 1 2] " +
        "\"point3 P\" [0 0 0  1 0 0  0 1 0]\nLightSource \"spot\"\n"
      val made = written(folder, view + coat)
      assert(made.files.contains("v4") && !made.files.contains(PeerScenes.Exchange))
      val why = made.failures(PeerScenes.Exchange)
      assert(why.contains("material \"coateddiffuse\"") && why.contains("shape \"loopsubdiv\""))
      assert(why.contains("light \"spot\"") && made.failures("v2").contains("to v2"))

  test("all programs get a box filter of one pixel and a path tracer of the scene's depth"):
    TempFolder.use: folder =>
      val other = view.replace("\"box\" \"float xradius\" .5 \"float yradius\" .5", "\"gaussian\"")
        .replace("\"path\" \"integer maxdepth\" 3", "\"bdpt\" \"integer maxdepth\" 7")
      val made = written(folder, other + world)
      assert(!made.isSame)
      val v4 = Files.readString(made.files("v4"))
      assert(v4.contains("PixelFilter \"box\"") && v4.contains("Integrator \"path\""))
      val exchange = Files.readString(made.files(PeerScenes.Exchange))
      assert(exchange.contains("""name="max_depth" value="8"""") && exchange.contains("\"box\""))
