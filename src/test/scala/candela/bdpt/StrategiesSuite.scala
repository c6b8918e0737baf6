package candela.bdpt

import org.scalatest.funsuite.AnyFunSuite

import candela.aov.Layer
import candela.diagnostics.Code
import candela.image.{Image, ImageEdits}
import candela.render.{CostKind, Renderer}
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

final class StrategiesSuite extends AnyFunSuite:
  import StrategiesSuite.*

  test("weighted strategies add up to the image, which is the same as without them"):
    val sky = """LightSource "infinite" "rgb L" [.3 .4 .5]"""
    val glow = """MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [.2 .2 .2]
      "rgb sigma_s" [.2 .3 .2] "rgb Le" [.3 .2 .1]
      AttributeBegin
      MediumInterface "fog" ""
      Material "interface"
      Translate -.5 .4 .7
      Shape "sphere" "float radius" .4
      AttributeEnd"""
    val filter = "PixelFilter \"gaussian\"\n"
    for
      (name, world, dialect) <- Seq(
        ("v3", glass(Dialect.V3), Dialect.V3),
        ("a sky", glass(Dialect.V4) + sky, Dialect.V4),
        ("media", glass(Dialect.V4) + glow, Dialect.V4)
      )
    do
      val deep = "\"integer maxdepth\" 3"
      val plain = rendered(filter + scene(deep, world, dialect), dialect)
      val image = rendered(filter + scene(s"$deep ${weighted(dialect)}", world, dialect), dialect)
      assert(image.channels == 3 + 3 * 13)
      assert(ImageEdits.select(image, Image.RgbNames).data.sameElements(plain.data), name)
      for pixel <- 0 until image.width * image.height; c <- 0 until 3 do
        val at = image.channels * pixel
        val sum = (3 + c until image.channels by 3).map(i => image.data(at + i).toDouble).sum
        val expected = image.data(at + c)
        // The products of a path are rounded in another order
        assert(Math.abs(sum - expected) < 2e-5 * (1 + expected), s"$name, pixel $pixel")

  test("each unweighted strategy has all the light of its paths"):
    val image = rendered(scene(s"$Shallow ${unweighted(Dialect.V4)}", "", Dialect.V4, 256))
    val direct = Seq("d01_s00_t03", "d01_s01_t02", "d01_s02_t01").map(mean(image, _))
    // 16,384 samples: of paths that hit the small light by chance, a deviation of 2 %
    for value <- direct do assert(Math.abs(value / direct(1) - 1) < 0.1, direct)
    val parts = rendered(scene(s"$Shallow ${weighted(Dialect.V4)}", "", Dialect.V4, 256))
    assert(mean(parts, "d01_s00_t03") < 0.5 * direct(0))

  test("there is an image for each strategy of pbrt's, and with both parameters, of the weighted"):
    val world = glass(Dialect.V4)
    val both = s"$Shallow ${unweighted(Dialect.V4)} ${weighted(Dialect.V4)}"
    val image = rendered(scene(both, world, Dialect.V4))
    val names = Vector("d00_s00_t02", "d01_s00_t03", "d01_s01_t02", "d01_s02_t01")
    assert(image.channelNames == Image.RgbNames ++
      names.flatMap(name => Image.RgbNames.map(c => s"bdpt_$name.$c")))
    val parts = rendered(scene(s"$Shallow ${weighted(Dialect.V4)}", world, Dialect.V4))
    assert(image.data.sameElements(parts.data))

  test("as in pbrt, paths have at most 5 scattering events if strategies are told apart"):
    val text = scene(s"\"integer maxdepth\" 9 ${unweighted(Dialect.V4)}", "", Dialect.V4)
    val problems = SceneTexts.problems(text, Dialect.V4)
    assert(problems.map(_.code) == Vector(Code.AsInPbrt), problems)
    assert(SceneTexts.plan(text, Dialect.V4).strategies.size == 26)
    assert(SceneTexts.problems(text.replace("9", "5"), Dialect.V4).isEmpty)

  test("the memory of all strategies is told before rendering"):
    def film(more: String) = SceneTexts.plan(scene(s"$Shallow $more", "", Dialect.V4), Dialect.V4)
      .costs.all.filter(_.kind == CostKind.Film).map(_.bytes).sum
    val pixels = 64
    // Of each of three colours, one sum and the image's value, of four strategies
    assert(film(unweighted(Dialect.V4)) - film("") >= pixels * 4 * 3 * (16 + 4))

  test("what is rendered by other means has no strategies"):
    val endless = """MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [.1 .1 .1]
      "rgb sigma_s" [.1 .1 .1]
      MediumInterface "" "fog""""
    val text = scene(weighted(Dialect.V4), """LightSource "infinite" "rgb L" [1 1 1]""", Dialect.V4)
      .replace("LookAt", s"$endless\nLookAt")
    val problems = SceneTexts.problems(text, Dialect.V4)
    assert(problems.exists(_.message.endsWith("and has no strategies to tell apart")), problems)
    assert(rendered(text).channelNames == Image.RgbNames)

  test("the layer `emission` is what the first surface emits, with strategies, too"):
    val emission = RenderSettings(layers = Vector(Layer.Emission))
    val images = Seq("", weighted(Dialect.V3)).map: more =>
      rendered(scene(s"$Shallow $more", "", Dialect.V3), Dialect.V3, emission)
    val layers = images.map(ImageEdits.select(_, Layer.Emission.channels).data)
    assert(layers(0).exists(_ > 0f))
    for (a, b) <- layers(0).zip(layers(1)) do assert(Math.abs(a - b) < 1e-5f * (1 + a))

private object StrategiesSuite:
  val Shallow = "\"integer maxdepth\" 1"

  private def bool(name: String, dialect: Dialect) =
    s"\"bool $name\" ${if dialect == Dialect.V4 then "true" else "\"true\""}"
  def weighted(dialect: Dialect): String = bool("visualizeweights", dialect)
  def unweighted(dialect: Dialect): String = bool("visualizestrategies", dialect)

  def glass(dialect: Dialect): String =
    s"""AttributeBegin
       |Material "${if dialect == Dialect.V4 then "dielectric" else "glass"}"
       |Translate .5 .3 .5
       |Shape "sphere" "float radius" .4
       |AttributeEnd
       |""".stripMargin

  /** A room with a lamp. */
  def scene(parameters: String, world: String, dialect: Dialect, samples: Int = 16): String =
    val isV4 = dialect == Dialect.V4
    val matte =
      if isV4 then "\"diffuse\" \"rgb reflectance\" [.6 .5 .4]"
      else "\"matte\" \"rgb Kd\" [.6 .5 .4]"
    s"""LookAt 0 -5 2.5  0 0 .8  0 0 1
       |Camera "perspective" "float fov" 40
       |Film "${if isV4 then "rgb" else "image"}" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "${if isV4 then "independent" else "random"}" "integer pixelsamples" $samples
       |Integrator "bdpt" $parameters
       |WorldBegin
       |Material $matte
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 5 6 4 6 7] "${
        if isV4 then "point3" else "point"
      } P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0  -2 2 0  2 2 0  2 2 3  -2 2 3]
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [8 6 4]
       |Translate -.5 0 2
       |Shape "sphere" "float radius" .4
       |AttributeEnd
       |$world
       |${if isV4 then "" else "WorldEnd"}
       |""".stripMargin

  def rendered(
      text: String,
      dialect: Dialect = Dialect.V4,
      settings: RenderSettings = RenderSettings()
  ): Image =
    val plan = SceneTexts.plan(text, dialect, settings)
    Renderer.render(plan, threads = 1).image(plan.development)

  def mean(image: Image, strategy: String): Double =
    val part = ImageEdits.select(image, Image.RgbNames.map(c => s"bdpt_$strategy.$c"))
    part.data.map(_.toDouble).sum / part.data.length
