package candela.build

import candela.concurrency.Parallel
import candela.diagnostics.{SceneError, Severity}
import org.scalatest.funsuite.AnyFunSuite

import candela.aov.Layer
import candela.color.{ColorSpace, Rgb}
import candela.film.{BoxFilter, GaussianFilter, PixelBounds}
import candela.integrators.{DirectLighting, Integrator, PathTracer}
import candela.render.{RenderPlan, Renderer, ThreadPool, Tiles}
import candela.sampling.{
  HaltonSampler, IndependentSampler, OwenSobolSampler, PointSet, StratifiedSampler, ZSobolSampler
}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, PointChoice, RenderRegion, RenderSettings}
import candela.testing.SceneTexts

final class SceneBuilderSuite extends AnyFunSuite:
  private val nothing = "WorldBegin\n"
  private val film = """Film "image" "integer xresolution" 80 "integer yresolution" 40"""

  private def integrator(plan: RenderPlan): Integrator = plan.method match
    case tiles: Tiles => tiles.integrators.create(None)
    case other => fail(s"$other")

  private def feature(plan: RenderPlan, name: String): String =
    plan.features.collectFirst { case (`name`, v) => v }.get

  test("where the scene says nothing, pbrt-v2's defaults hold"):
    val plan = SceneTexts.plan(nothing, Dialect.V2)
    assert((plan.width, plan.height) == (640, 480))
    assert(plan.filter.isInstanceOf[BoxFilter] && plan.filter.radiusX == 0.5f)
    assert(plan.sampler.isInstanceOf[OwenSobolSampler] && plan.sampler.samplesPerPixel == 4)
    assert(integrator(plan).isInstanceOf[DirectLighting])
    assert(plan.basis.isSrgb)

  test("the seed of the scene and that of the settings both change the noise"):
    val scene = """Film "rgb" "integer xresolution" 8 "integer yresolution" 8
      Sampler "independent" "integer pixelsamples" 1 Integrator "path" WorldBegin
      LightSource "infinite" Shape "sphere" "float radius" .4"""
    def noise(inScene: Int, inSettings: Int): Seq[Float] =
      val text = s"Option \"integer seed\" $inScene Camera \"perspective\" $scene"
        .replace("WorldBegin", "WorldBegin Translate 0 0 2")
      val plan = SceneTexts.plan(text, Dialect.V4, RenderSettings(seed = inSettings))
      Renderer.render(plan, threads = 1).image(plan.development).data.toSeq
    assert(noise(1, 0) == noise(1, 0))
    assert(noise(1, 0) != noise(2, 0))
    assert(noise(1, 0) != noise(1, 3))

  test("where the scene says nothing, pbrt-v3's defaults hold"):
    val plan = SceneTexts.plan(nothing, Dialect.V3)
    assert((plan.width, plan.height) == (1280, 720))
    assert(plan.filter.isInstanceOf[BoxFilter] && plan.filter.radiusX == 0.5f)
    assert(plan.sampler.isInstanceOf[OwenSobolSampler] && plan.sampler.samplesPerPixel == 16)
    assert(integrator(plan).isInstanceOf[PathTracer])
    assert(plan.basis.isSrgb)

  test("where the scene says nothing, pbrt-v4's defaults hold"):
    val plan = SceneTexts.plan(nothing, Dialect.V4)
    assert((plan.width, plan.height) == (1280, 720))
    assert(plan.filter.isInstanceOf[GaussianFilter] && plan.filter.radiusX == 1.5f)
    assert(plan.sampler.isInstanceOf[ZSobolSampler] && plan.sampler.samplesPerPixel == 16)
    assert(integrator(plan).isInstanceOf[PathTracer])
    assert(!plan.basis.isSrgb)

  test("sets of wavelengths are made in parallel; the image and messages are the same"):
    val scene = """
      Film "rgb" "integer xresolution" 12 "integer yresolution" 6
      WorldBegin
      LightSource "infinite" "rgb L" [1 .7 .4]
      Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"
        "float roughness" .3 "float nonsense" 1
      Translate -1 0 3 Shape "sphere"
      Material "coateddiffuse" "rgb reflectance" [.1 .6 .3] "float other" 1
      Translate 2 0 0 Shape "sphere" """
    def made(pool: Parallel) =
      val options = RenderSettings(color = ColorMode.Spectral)
      val description = SceneTexts.parse(scene, Dialect.V4)
      val (plan, problems) = SceneBuilder.build(description, options, pool = pool)
      val image = Renderer.render(plan, threads = 1).image(plan.development)
      (image.data.toVector, problems.map(_.message))
    val alone = made(Parallel.Alone)
    assert(alone._1.exists(_ > 0f) && alone._2.sizeIs >= 2)
    assert(made(ThreadPool(4)) == alone)

  test("evenly spread points of any kind are those with the least noise, unless asked otherwise"):
    def sampler(statement: String, choice: PointChoice) =
      val plan = SceneTexts.plan(
        s"Sampler $statement\n$nothing",
        Dialect.V3,
        RenderSettings(points = Some(choice))
      )
      (plan.sampler.getClass, plan.sampler.samplesPerPixel, feature(plan, "sampler"))
    val halton = "\"halton\" \"integer pixelsamples\" 9"
    assert(sampler(halton, PointChoice.Best) == (
      classOf[OwenSobolSampler],
      9,
      "scrambled Sobol' points, which have less noise than \"halton\" (--sampler scene takes " +
        "scrambled Halton points)"
    ))
    val own = (classOf[HaltonSampler], 9, "scrambled Halton points, for \"halton\"")
    assert(sampler(halton, PointChoice.Scene) == own)
    val named = sampler(halton, PointChoice.Named(PointSet.ZSobol))
    assert(named._1 == classOf[ZSobolSampler] && named._3.endsWith(", by --sampler"))
    val strata = "\"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 2"
    assert(sampler(strata, PointChoice.Best)._1 == classOf[OwenSobolSampler])
    assert(sampler(strata, PointChoice.Scene)._1 == classOf[StratifiedSampler])
    assert(sampler(s"$strata \"bool jitter\" \"false\"", PointChoice.Best)._1 ==
      classOf[StratifiedSampler])
    for choice <- Seq(PointChoice.Best, PointChoice.Progressive) do
      assert(sampler("\"random\"", choice)._1 == classOf[IndependentSampler])

  test("independent points are taken where somebody has chosen them: not in Mitsuba's scenes"):
    val text = s"Sampler \"independent\" \"integer pixelsamples\" 9\n$nothing"
    def sampler(isMitsubas: Boolean, choice: PointChoice) =
      val dialect = if isMitsubas then Dialect.Mitsuba else Dialect.V4
      val scene = SceneTexts.parse(text, Dialect.V4).copy(dialect = dialect)
      val plan = SceneBuilder.build(scene, RenderSettings(points = Some(choice)))._1
      (plan.sampler.getClass, plan.sampler.samplesPerPixel, feature(plan, "sampler"))
    val own = (classOf[IndependentSampler], 9, "independent random numbers, for \"independent\"")
    assert(sampler(isMitsubas = false, PointChoice.Best) == own)
    assert(sampler(isMitsubas = true, PointChoice.Scene) == own)
    assert(sampler(isMitsubas = true, PointChoice.Best) == (
      classOf[OwenSobolSampler],
      9,
      "scrambled Sobol' points, which have less noise than \"independent\" (--sampler scene " +
        "takes independent random numbers)"
    ))

  test("points whose number is fixed are replaced where any number must be evenly spread"):
    def sampler(choice: PointChoice) =
      SceneTexts.plan(nothing, Dialect.V4, RenderSettings(points = Some(choice))).sampler
    assert(sampler(PointChoice.Best).isInstanceOf[ZSobolSampler])
    assert(sampler(PointChoice.Progressive).isInstanceOf[OwenSobolSampler])

  test("a number of samples that the points can't have is said, as is what is rendered"):
    def of(spp: Int, sampler: String = "\"zsobol\"") =
      val text = s"Sampler $sampler\n$nothing"
      val options = RenderSettings(samples = Some(spp), points = Some(PointChoice.Scene))
      val found = SceneTexts.problems(text, Dialect.V4, options = options)
      (SceneTexts.plan(text, Dialect.V4, options).sampler.samplesPerPixel, found.map(_.message))
    val none = of(256)
    assert(none._1 == 256)
    val rounded = of(300)
    assert(rounded._1 == 512)
    assert(rounded._2.diff(none._2) == Vector(
      "\"zsobol\" takes 512 samples per pixel, the next power of two, not 300"
    ))
    val replaced = of(Int.MaxValue)
    assert(replaced._1 == Int.MaxValue)
    assert(replaced._2.diff(none._2).head.contains("at most 16777216 samples per pixel"))

  test("more strata than there are numbers of samples are an error"):
    val text = s"Sampler \"stratified\" \"integer xsamples\" 100000 \"integer ysamples\" 100000\n"
    val found = SceneTexts.problems(text + nothing, Dialect.V4)
    assert(found.exists(_.message.contains("at most 2147483647 samples per pixel, found")))

  test("the whole image is rendered unless the scene or the caller crops it"):
    assert(SceneTexts.plan(s"$film\n$nothing").crop == PixelBounds(0, 0, 80, 40))
    val cropped = s"$film \"float cropwindow\" [0.25 0.5 0.5 1]\n$nothing"
    assert(SceneTexts.plan(cropped).crop == PixelBounds(20, 20, 40, 40))
    val rgb = film.replace("image", "rgb")
    val pixels = s"$rgb \"integer pixelbounds\" [3 7 5 9]\n$nothing"
    assert(SceneTexts.plan(pixels, Dialect.V4).crop == PixelBounds(3, 5, 7, 9))
    val both = s"$rgb \"integer pixelbounds\" [3 7 5 9] \"float cropwindow\" [0.25 0.5 0.5 1]"
    assert(SceneTexts.plan(s"$both\n$nothing", Dialect.V4).crop == PixelBounds(20, 20, 40, 40))
    val asked = RenderSettings(region = RenderRegion.Window(0f, 0.1f, 0f, 0.1f))
    assert(SceneTexts.plan(cropped, options = asked).crop == PixelBounds(0, 0, 8, 4))

  test("windows in pixels are those pixels, at any width"):
    for width <- Vector(100, 400, 1920, 15000); x <- 0 until width by Math.max(1, width / 500) do
      val film = s"Film \"rgb\" \"integer xresolution\" $width \"integer yresolution\" 9"
      val text = s"$film \"integer pixelbounds\" [$x ${x + 1} 2 4]\n$nothing"
      assert(SceneTexts.plan(text, Dialect.V4).crop == PixelBounds(x, 2, x + 1, 4))

  test("a film may be larger than memory: a window of it costs what the window does"):
    def film(window: String) =
      s"Film \"image\" \"integer xresolution\" 45000 \"integer yresolution\" 46000 $window\n"
    val window = "\"float cropwindow\" [.5 .5001 .5 .5001]"
    val methods = Vector(
      "Integrator \"path\"",
      "Integrator \"bdpt\"",
      "Integrator \"sppm\" \"integer iterations\" 1",
      "Integrator \"mlt\" \"integer mutationsperpixel\" 1 \"integer bootstrapsamples\" 64"
    )
    val samplers = Vector("random", "halton", "sobol", "stratified", "02sequence", "maxmindist")
    val lit = "LightSource \"infinite\"\nTranslate 0 0 3\nShape \"sphere\"\nWorldEnd"
    for method <- methods; sampler <- if method.contains("path") then samplers else Seq("halton") do
      val text = s"${film(window)}Sampler \"$sampler\" \"integer pixelsamples\" 1\n$method\n" +
        s"Camera \"perspective\"\nWorldBegin\n$lit"
      val scenes = RenderSettings(points = Some(PointChoice.Scene))
      val plan = SceneTexts.plan(text, options = scenes)
      assert(plan.crop == PixelBounds(22500, 23000, 22505, 23005), method)
      val image = Renderer.render(plan, threads = 1).image(plan.development)
      assert(image.width == 5 && image.data.exists(_ > 0f), s"$method $sampler")
    val whole = SceneTexts.problems(s"${film("")}$nothing").map(_.message)
    assert(whole == Vector("can't render 45000×46000 pixels at once, at most 134217727"))

  test("nor are layers, bands or groups of lights that would need more"):
    def refused(film: String, layers: Vector[Layer], lights: Int = 1) =
      val world = "LightSource \"point\" ".repeat(lights)
      val text = s"Film $film \"integer xresolution\" 9000 \"integer yresolution\" 9000\n" +
        s"Integrator \"path\"\nWorldBegin $world Shape \"sphere\""
      val scene = SceneTexts.parse(text, Dialect.V4)
      // Such a film would not fit the heap of the tests either
      val settings = RenderSettings(layers = layers)
      intercept[SceneError](SceneBuilder.build(scene, settings, heap = Long.MaxValue))
        .problems.filter(_.severity == Severity.Error).map(_.message)
    val all = Layer.values.toVector.filterNot(_.dividesLight)
    val why = "can't render 9000×9000 pixels with all their"
    assert(refused("\"rgb\"", all) == Vector(s"$why layers at once"))
    assert(refused("\"rgb\"", Vector(Layer.Lights), lights = 20) == Vector(s"$why layers at once"))
    assert(refused(
      "\"spectral\" \"integer nbuckets\" 40",
      Vector.empty
    ) == Vector(s"$why bands at once"))

  test("v4's images are the brighter the longer the shutter is open; older ones are not"):
    val camera = "Camera \"perspective\" \"float shutteropen\" 0.25 \"float shutterclose\" 0.75"
    val film = "Film \"rgb\" \"float iso\" 400 \"float maxcomponentvalue\" 6"
    val v4 = SceneTexts.plan(s"$camera\n$film\n$nothing", Dialect.V4)
    // 400 / 100 · 0.5 s; samples are limited as the sensor sees them, before that
    assert(v4.development.scale == 2f && v4.limit.map(_.maximum) == Some(3f))
    assert(SceneTexts.plan(s"$camera\n$nothing", Dialect.V3).development.scale == 1f)
    val closed = s"Camera \"perspective\" \"float shutterclose\" 0\n$nothing"
    assert(SceneTexts.problems(
      closed,
      Dialect.V4
    ).exists(_.message.contains("must close after it opens")))

  test("a crop window without a pixel is an error"):
    val empty = RenderSettings(region = RenderRegion.Window(0.5f, 0.5f, 0f, 1f))
    val error = intercept[SceneError](SceneTexts.plan(s"$film\n$nothing", options = empty))
    assert(error.getMessage.contains("no pixel"))

  test("quick: a sixteenth of the pixels with one sample each"):
    val plan = SceneTexts.plan(s"$film\n$nothing", options = RenderSettings(quick = true))
    assert((plan.width, plan.height, plan.sampler.samplesPerPixel) == (20, 10, 1))

  test("the caller's number of samples replaces the scene's"):
    val scene = s"Sampler \"stratified\" \"integer xsamples\" 2 \"integer ysamples\" 3\n$nothing"
    assert(SceneTexts.plan(scene).sampler.samplesPerPixel == 6)
    val asked = RenderSettings(samples = Some(12))
    assert(SceneTexts.plan(scene, options = asked).sampler.samplesPerPixel == 12)

  test("film settings reach the plan"):
    val scene = s"$film \"string filename\" \"a.png\" \"float scale\" 2\n$nothing"
    val plan = SceneTexts.plan(scene)
    assert(plan.filename == "a.png" && plan.development.scale == 2f)

  private val triangle =
    """Shape "trianglemesh" "integer indices" [0 1 2] "point P" [0 0 0 1 0 0 0 1 0]"""

  test("the image is in the colour space of the film; the world may use another"):
    val film = "Film \"rgb\" \"integer xresolution\" 2 \"integer yresolution\" 2 " +
      "Sampler \"independent\" \"integer pixelsamples\" 1 Camera \"perspective\" WorldBegin "
    val light = "LightSource \"infinite\" \"rgb L\" [.5 1 .25]"
    def close(c: Rgb, wanted: Rgb) = (c - wanted).map(Math.abs).max < 2e-5f
    for space <- ColorSpace.all do
      val own = SceneTexts.mean(s"ColorSpace \"$space\" $film $light", Dialect.V4)
      assert(close(own, Rgb(.5f, 1f, .25f)), s"$space: $own")
      val inSrgb = SceneTexts.mean(s"$film ColorSpace \"$space\" $light", Dialect.V4)
      assert(close(inSrgb, space.light(Rgb(.5f, 1f, .25f))), s"$space: $inSrgb")
      val white = SceneTexts.mean(
        s"ColorSpace \"$space\" $film LightSource \"infinite\"",
        Dialect.V4
      )
      assert(close(white, Rgb.White), s"$space: $white")

  test("shapes of an object appear where its instances are, and only there"):
    val scene = s"""WorldBegin
                   |ObjectBegin "leaf"
                   |$triangle
                   |Shape "sphere"
                   |ObjectEnd
                   |ObjectInstance "leaf"
                   |Translate 5 0 0
                   |ObjectInstance "leaf"
                   |WorldEnd""".stripMargin
    val plan = SceneTexts.plan(scene)
    assert(feature(plan, "triangles") == "0" && feature(plan, "other shapes") == "0")
    assert(feature(plan, "instances").startsWith("2 of 1 objects with 1 triangles"))
    val unused = scene.replace("ObjectInstance \"leaf\"", "")
    assert(feature(SceneTexts.plan(unused), "instances") == "none")

  test("an instance of no object is an error with the nearest name"):
    val scene = s"WorldBegin\nObjectBegin \"leaf\"\n$triangle\nObjectEnd\nObjectInstance \"laef\"\n"
    val problem =
      SceneTexts.problems(scene).find(_.message.contains("object `laef` is not defined")).get
    assert(problem.help.exists(_.contains("`leaf`")) && problem.pos.map(_.line).contains(5))

  test("a named material is made once, however many shapes have it"):
    val scene = s"""WorldBegin
                   |MakeNamedMaterial "red" "string type" "matte" "rgb Kd" [1 0 0]
                   |NamedMaterial "red"
                   |$triangle
                   |$triangle
                   |WorldEnd""".stripMargin
    assert(feature(SceneTexts.plan(scene), "materials").startsWith("1,"))

  test("a material name that nothing has is an error with the nearest name"):
    val scene = s"WorldBegin\nMakeNamedMaterial \"red\" \"string type\" \"matte\"\n" +
      s"NamedMaterial \"rde\"\n$triangle\n"
    val problem = SceneTexts.problems(scene).find(_.message.contains("is not defined")).get
    assert(problem.help.exists(_.contains("`red`")))

  test("every triangle of a mesh that emits is a light"):
    val scene = s"WorldBegin\nAreaLightSource \"diffuse\"\n$triangle\n$triangle\nShape \"disk\"\n"
    assert(feature(SceneTexts.plan(scene), "lights").startsWith("3 lights"))

  test("a world without light says that it will be black"):
    val scene = s"Camera \"perspective\"\nWorldBegin\n$triangle\n"
    assert(SceneTexts.problems(scene).exists(_.message.contains("no light")))
    val lit = scene + "LightSource \"point\"\n"
    assert(SceneTexts.problems(lit).isEmpty)

  test("shapes of an interface give no light in v4, as in pbrt"):
    val emitter = "AreaLightSource \"diffuse\"\nShape \"disk\"\n"
    val sky = "LightSource \"infinite\"\n"
    val v4 = s"WorldBegin\n${sky}Material \"interface\"\n$emitter"
    assert(feature(SceneTexts.plan(v4, Dialect.V4), "lights").startsWith("one light"))
    assert(SceneTexts.problems(v4, Dialect.V4).exists(_.message.contains("gives no light")))
    val v3 = s"WorldBegin\n${sky}Material \"none\"\n$emitter"
    assert(feature(SceneTexts.plan(v3, Dialect.V3), "lights").startsWith("2 lights"))
