package candela.render

import candela.aov.Layer
import candela.build.SceneBuilder
import candela.color.Rgb
import candela.film.GaussianFilter
import candela.image.Image
import candela.sampling.{PointSet, Sampler}
import candela.scenefile.Dialect
import candela.settings.{BuildControl, RenderGoal, RenderSettings}
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

class AdaptiveSamplingSuite extends AnyFunSuite:
  private val Few = 4
  private val All = 32

  private def formula(radiance: (Where, Sampler) => Rgb): RenderPlan =
    val adaptive = AdaptiveSampling(HashSampler(Few), SampleDifference.Contrast)
    TinyPlan(spp = All, adaptive = Some(adaptive))(radiance)

  private def image(plan: RenderPlan, threads: Int = 1): Image =
    Renderer.render(plan, threads).image(plan.development)

  /** Whether a sample is one of the first of its pixel. */
  private def isFirst(sampler: Sampler): Boolean = sampler.samplesPerPixel == Few

  test("a flat picture has the first samples everywhere, and no others are traced"):
    for light <- Vector(0f, 1f) do
      val plan = formula: (_, sampler) =>
        assert(isFirst(sampler))
        Rgb.gray(light * (1 + 0.3f * sampler.next1D()))
      val done = Renderer.render(plan, threads = 1)
      val pixels = done.film.width * done.film.height
      assert(done.samplesTaken == Few * pixels && done.rays == done.samplesTaken)
      assert(done.samplesSpared == (All - Few) * pixels && done.takenShare == Few.toDouble / All)
      assert(done.isComplete)

  test("where the first samples differ, all others replace them"):
    val plan = formula: (where, sampler) =>
      if where.x != 20 then Rgb.gray(1f)
      else if isFirst(sampler) then Rgb.gray(if where.sample == 2 then 99f else 0f)
      else Rgb.gray(where.sample.toFloat)
    val done = Renderer.render(plan, threads = 1)
    val (width, height) = (done.film.width, done.film.height)
    assert(done.samplesTaken == (Few * (width - 1) + All) * height)
    assert(done.rays == done.samplesTaken + Few * height)
    val data = done.image(plan.development).data
    for pixel <- 0 until width * height do
      val expected = if pixel % width == 20 then (All - 1) / 2f else 1f
      assert(data(3 * pixel) == expected, pixel)

  test("samples contrast if one is further from the mean than half of it, as in pbrt-v2"):
    // With three samples of 1 and one of 1 + a, the mean is 1 + a / 4
    for (a, differs) <- Vector(0.79f -> false, 0.81f -> true, -0.56f -> false, -0.58f -> true) do
      val plan = formula: (where, _) =>
        Rgb.gray(if where.sample == 3 then 1 + a else 1f)
      assert((Renderer.render(plan, threads = 1).samplesSpared == 0) == differs, a)

  test("discarded samples are black to the comparison, and left out of the image"):
    for several <- Vector(false, true) do
      val plan = formula: (where, sampler) =>
        if several && where.sample == 1 then Rgb.gray(Float.NaN)
        else if several || !isFirst(sampler) then Rgb.gray(1f)
        else Rgb.gray(Float.NaN)
      val done = Renderer.render(plan, threads = 1)
      val pixels = done.film.width * done.film.height
      assert(done.samplesTaken == (if several then All else Few) * pixels)
      assert(done.discarded.map(_.count).contains(if several then pixels else Few * pixels))

  private val noise: (Where, Sampler) => Rgb = (where, sampler) =>
    Rgb(sampler.next1D(), sampler.next1D() * (1e-6f + where.x * 1e-2f), 1e-3f)

  private def noisy(shares: Boolean): RenderPlan =
    val adaptive = AdaptiveSampling(HashSampler(2), SampleDifference.Contrast)
    TinyPlan(
      spp = 8,
      filter = GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f),
      sharesSamples = shares,
      adaptive = Some(adaptive)
    )(noise)

  test("the image is the same on any number of threads, bit for bit"):
    for shares <- Vector(false, true) do
      val one = Renderer.render(noisy(shares), threads = 1)
      assert(one.takenShare > 0.3 && one.takenShare < 0.9)
      val alone = one.image(noisy(shares).development).data
      for threads <- Vector(2, 4) do
        assert(image(noisy(shares), threads).data.sameElements(alone))

  test("shards take whole tiles, and all tiles once"):
    val whole = Renderer.render(noisy(shares = false), threads = 1)
    val parts = (0 until 3).map: i =>
      Renderer.render(noisy(shares = false), RenderControl(shard = Shard(i, 3)))
    assert(parts.map(_.samplesTaken).sum == whole.samplesTaken)
    val black = parts.map(_.image(noisy(shares = false).development).data)
    val all = image(noisy(shares = false)).data
    assert(all.indices.forall(i => black.count(_(i) == all(i)) == 1))

  /** A square of two triangles that shines, seen in part through checks. */
  private def scene(method: String, checks: Boolean): String =
    val colors =
      if checks then "\"rgb tex1\" [ 1 1 1 ] \"rgb tex2\" [ 0.1 0.1 0.1 ]"
      else "\"rgb tex1\" [ 1 1 1 ] \"rgb tex2\" [ 1 1 1 ]"
    s"""LookAt 0 0 5  0 0 0  0 1 0
       |Camera "perspective" "float fov" 40
       |Film "image" "integer xresolution" 32 "integer yresolution" 32
       |PixelFilter "box" "float xwidth" 0.5 "float ywidth" 0.5
       |Sampler "adaptive" "string method" "$method"
       |SurfaceIntegrator "directlighting"
       |WorldBegin
       |LightSource "distant" "point from" [ 0 0 1 ] "point to" [ 0 0 0 ] "rgb L" [ 1 1 1 ]
       |Texture "checks" "color" "checkerboard" "float uscale" 8 "float vscale" 8 $colors
       |Material "matte" "texture Kd" "checks"
       |Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
       |  "point P" [ -5 -5 0  5 -5 0  5 5 0  -5 5 0 ] "float uv" [ 0 0 1 0 1 1 0 1 ]
       |WorldEnd
       |""".stripMargin

  private def pixelsWithAll(method: String, checks: Boolean): Long =
    val plan = SceneTexts.plan(scene(method, checks), Dialect.V2)
    val spared = Renderer.render(plan, threads = 1).samplesSpared
    assert(spared % (All - Few) == 0)
    32 * 32 - spared / (All - Few)

  test("contrast needs no edge, and an edge of triangles no contrast"):
    assert(pixelsWithAll("contrast", checks = false) == 0)
    // The diagonal, of 32 pixels, and those beside it that samples of its other side hit
    val diagonal = pixelsWithAll("shapeid", checks = false)
    assert(diagonal >= 28 && diagonal <= 64, diagonal)
    assert(pixelsWithAll("shapeid", checks = true) == diagonal)
    val checks = pixelsWithAll("contrast", checks = true)
    assert(checks > 100 && checks < 400, checks)

  test("with layers, the colours are the same"):
    val text = scene("contrast", checks = true)
    val plain = image(SceneTexts.plan(text, Dialect.V2)).data
    val plan = SceneTexts.plan(text, Dialect.V2, RenderSettings(layers = Vector(Layer.Albedo)))
    assert(plan.adaptive.isDefined)
    val layered = image(plan)
    for pixel <- 0 until 32 * 32; c <- 0 until 3 do
      assert(layered.data(layered.channels * pixel + c) == plain(3 * pixel + c), (pixel, c))

  test("a number of samples, and what ends a rendering, take the same number everywhere"):
    val description = SceneTexts.parse(scene("contrast", checks = true), Dialect.V2)
    def plan(settings: RenderSettings, control: BuildControl = BuildControl()) =
      SceneBuilder.build(description, settings, control)._1
    val own = plan(RenderSettings())
    assert(own.adaptive.isDefined)
    val sampler = own.features.toMap.apply("sampler")
    assert(sampler.endsWith("32 samples in pixels whose first 4 contrast, otherwise these"))
    val goal = RenderGoal(time = Some(1))
    for
      other <- Vector(
        plan(RenderSettings(samples = Some(8))),
        plan(RenderSettings(quick = true)),
        plan(RenderSettings(goal = goal)),
        plan(RenderSettings(), BuildControl(samples = Some(8)))
      )
    do
      assert(other.adaptive.isEmpty)
      assert(!other.features.toMap.apply("sampler").contains("first"))

  test("the points may be others; samples of the pixel's centre all agree, and have all"):
    import candela.settings.PointChoice
    val text = scene("contrast", checks = true)
    val halton = RenderSettings(points = Some(PointChoice.Named(PointSet.Halton)))
    assert(SceneTexts.plan(text, Dialect.V2, halton).adaptive.isDefined)
    val centers = RenderSettings(centers = true)
    assert(SceneTexts.plan(text, Dialect.V2, centers).adaptive.isEmpty)
    val warnings = SceneTexts.problems(text, Dialect.V2, options = centers).map(_.message)
    assert(warnings.exists(_.startsWith("every pixel takes 32 samples: ")))
