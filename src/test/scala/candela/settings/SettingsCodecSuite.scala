package candela.settings

import candela.aov.Layer
import candela.color.{Rgb, ToneCurve}
import candela.film.{Fireflies, PixelBounds}
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.image.{DisplayTransform, Exposure}
import candela.scenefile.{Dialect, Resolution}

import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

class SettingsCodecSuite extends AnyFunSuite with ScalaCheckPropertyChecks:
  private val flag = Gen.oneOf(false, true)
  private val positive = Gen.choose(1e-6f, 1e6f)
  private val name = Gen.identifier

  private val regions: Gen[RenderRegion] =
    val part = Gen.choose(0f, 1f)
    val window =
      for x0 <- part; x1 <- part; y0 <- part; y1 <- part if x0 < x1 && y0 < y1
      yield RenderRegion.Window(x0, x1, y0, y1)
    val start = Gen.choose(-9, 9)
    val size = Gen.choose(1, 9)
    val pixels =
      for x <- start; y <- start; w <- size; h <- size
      yield RenderRegion.Pixels(PixelBounds(x, y, x + w, y + h))
    val pixel = for x <- size; y <- size yield RenderRegion.Pixel(x, y)
    Gen.oneOf(Gen.const(RenderRegion.Whole), window, pixels, pixel)

  private val groupings: Gen[LightGrouping] =
    val groups =
      for names <- Gen.nonEmptyListOf(name); lights <- Gen.nonEmptyListOf(name)
      yield LightGrouping.Named(names.distinct.toVector.map(_ -> lights.toVector))
    Gen.oneOf(Gen.const(LightGrouping.Statements), Gen.const(LightGrouping.Types), groups)

  private val firefliesGen: Gen[Fireflies] = Gen.oneOf(
    Gen.const(Fireflies.Kept),
    Gen.const(Fireflies.Reweighted),
    positive.map(Fireflies.Clamped(_))
  )

  private val displays: Gen[DisplayTransform] =
    val stops = Gen.choose(-100f, 100f).map(Exposure.Stops(_))
    for
      curve <- Gen.oneOf(ToneCurve.values.toSeq)
      exposure <- Gen.oneOf(stops, Gen.const(Exposure.Auto))
      falseColor <- flag
      bits <- Gen.oneOf(8, 16)
      dithers <- flag
    yield DisplayTransform(curve, exposure, falseColor, bits, dithers)

  private val readings: Gen[ReadSettings] =
    for
      dialect <- Gen.option(Gen.oneOf(Dialect.ofPbrt))
      defines <- Gen.mapOf(Gen.zip(name, Gen.alphaNumStr))
      keepGoing <- flag
      sensors <- Gen.option(Gen.oneOf(Sensors.All, Sensors.One(0), Sensors.One(3)))
      resolution <- Gen.option(
        Gen.oneOf(Resolution.Size(640, 360), Resolution.Width(7), Resolution.Percent(12.5))
      )
      light <- Gen.option(Gen.oneOf(
        ModelLight.Studio,
        ModelLight.Sky,
        ModelLight.Surroundings("a b.exr")
      ))
      ground <- Gen.option(Gen.oneOf(
        ModelGround.Empty,
        ModelGround.Colored(Rgb(0.1f, 0f, 1f))
      ))
      turntable <- Gen.option(Gen.choose(1, 10000))
      times <- Gen.option(Gen.oneOf(
        Gen.choose(0.0, 1e3).map(ModelTimes.at),
        Gen.choose(2, 1000).map(ModelTimes(0.5, 0.125, _))
      ))
      animation <- Gen.option(name)
      variant <- Gen.option(name)
      up <- Gen.option(Gen.oneOf(UpAxis.values.toSeq))
      model = ModelSettings(light, ground, turntable, ModelState(times, animation, variant), up)
      camera <- Gen.option(Gen.const("a b.pbrt"))
    yield ReadSettings(dialect, defines, keepGoing, sensors, resolution, model, camera)

  /** Precisions are of layers that are there. */
  private def outputs(layers: Vector[Layer]): Gen[OutputSettings] =
    for
      halves <- Gen.listOfN(layers.size, Gen.option(flag))
      denoise <- flag
      storeTime <- flag
      display <- Gen.oneOf(Gen.const(DisplayTransform.Plain), displays)
      reference <- Gen.option(name)
      errors <- Gen.option(name)
    yield
      val precisions = layers.zip(halves).collect { case (layer, Some(isHalf)) => layer -> isHalf }
      OutputSettings(precisions.toMap, denoise, storeTime, display, reference, errors)

  private val settings: Gen[RenderSettings] =
    for
      samples <- Gen.option(Gen.posNum[Int])
      seed <- Gen.oneOf(Gen.choose(Int.MinValue, Int.MaxValue), Gen.const(0))
      time <- Gen.option(Gen.choose(1e-3, 1e6))
      error <- Gen.option(Gen.choose(1e-9, 9.0))
      quick <- flag
      preview <- flag
      region <- regions
      layers <- Gen.someOf(Layer.values.toSeq).map(_.toVector)
      groups <- Gen.option(groupings)
      color <- Gen.oneOf(ColorMode.values.toSeq)
      points <- Gen.option(Gen.oneOf(PointChoice.all))
      fireflies <- firefliesGen
      guiding <- Gen.option(Gen.oneOf(GuidingMode.values.toSeq))
      caustics <- Gen.option(Gen.oneOf(CausticsMode.values.toSeq))
      flags <- Gen.listOfN(5, flag)
      sky <- Gen.option(Gen.oneOf(SkyView.values.toSeq))
      edgeScale <- Gen.option(positive)
      reading <- readings
      output <- outputs(layers)
    yield
      val Vector(centers, unfiltered, meanImages, oneColorSet, diffuse) = flags.toVector: @unchecked
      RenderSettings(
        samples,
        seed,
        RenderGoal(time, error),
        quick,
        preview,
        region,
        layers,
        groups,
        color,
        points,
        fireflies,
        guiding,
        caustics,
        centers,
        unfiltered,
        meanImages,
        oneColorSet,
        diffuse,
        sky,
        edgeScale,
        reading,
        output
      )

  test("the settings of these tests have every field"):
    val fields = Vector(RenderSettings(), RenderGoal(), ReadSettings(), OutputSettings())
    assert(fields.map(_.productArity) == Vector(22, 2, 7, 6), "`settings` must make the new field")

  test("settings are read from words as they were written, all of them", Slow):
    forAll(settings, minSuccessful(500)): s =>
      assert(SettingsCodec.settings(SettingsCodec.words(s)) == Right(s))

  test("the words that identify an image lack its samples, goals and errors, and nothing else"):
    forAll(settings): s =>
      val output = s.output.copy(reference = None, errors = None)
      val shaping = s.chosen.copy(samples = None, goal = RenderGoal(), output = output)
      val read = SettingsCodec.settings(SettingsCodec.identity(s)).map(_.chosen)
      assert(read == Right(shaping))

  test("a film's settings keep what was chosen for a goal, or by the scene, with any goal"):
    val goal = RenderGoal(time = Some(10))
    val timed = SettingsCodec.identity(RenderSettings(goal = goal))
    val words = "--sampler progressive --guiding auto --caustics auto"
    assert(timed == words.split(' ').toVector)
    val asked = RenderSettings(
      goal = goal,
      points = Some(PointChoice.Best),
      guiding = Some(GuidingMode.Off),
      caustics = Some(CausticsMode.Off)
    )
    assert(SettingsCodec.identity(asked).isEmpty)
    for s <- Vector(RenderSettings(), asked) do
      val film = SettingsCodec.settings(SettingsCodec.identity(s)).map(_.chosen).toOption.get
      assert(SettingsCodec.identity(film.copy(goal = goal)).isEmpty)

  test("what films of earlier versions have is read, and written alike"):
    val first =
      "--seed 7 --quick --cropwindow 0.0,0.5,0.25,1.0 --aov depth:half,albedo,lights " +
        "--light-groups key=point_3+spot_4,sky=infinite --denoise --dialect v3 --define a=1 " +
        "--define b=2=3 --keep-going --color spectral --sampler halton --fireflies clamp:2.5 " +
        "--store-time --tonemap aces --exposure -2.0 --falsecolor --bits 16 --dither " +
        "--disable-pixel-jitter --disable-texture-filtering --disable-image-textures " +
        "--disable-wavelength-jitter --force-diffuse --guiding auto " +
        "--displacement-edge-scale 2.5"
    for text <- Vector(first, "--tonemap linear --bits 16", "--pixelbounds 3,9,-2,5", "--pixel 7,8")
    do
      val words = text.split(' ').toVector
      assert(SettingsCodec.settings(words).map(SettingsCodec.identity) == Right(words))

  test("words that are no settings are refused"):
    def wrong(text: String) = SettingsCodec.settings(text.split(' ').toVector).left.toOption.get
    assert(wrong("--sandbox") == "unknown setting `--sandbox`")
    assert(wrong("scene.pbrt") == "unknown setting `scene.pbrt`")
    assert(wrong("--seed") == "wrong value of `--seed`")
    for text <- Vector(
        "--seed x", "--bits 9", "--cropwindow 1,0,0,1", "--pixel -1,2", "--guiding directions",
        "--resolution 0x5", "--resolution x5", "--resolution -1", "--resolution 0%",
        "--fireflies clamp:0", "--aov depth,nothing", "--define x", "--exposure 1000"
      )
    do assert(wrong(text).startsWith("wrong value of `--"), text)
