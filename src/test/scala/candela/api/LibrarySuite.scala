package candela.api

import candela.cli.Captured
import candela.testing.{Eventually, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

import java.io.{ByteArrayInputStream, ByteArrayOutputStream, OutputStream, PrintStream}
import java.nio.file.{Files, Path}
import java.time.Duration
import java.util.concurrent.{CancellationException, CyclicBarrier}
import java.util.concurrent.TimeUnit.SECONDS
import javax.imageio.ImageIO

import scala.jdk.CollectionConverters.*
import scala.util.Using

class LibrarySuite extends AnyFunSuite:

  private def rendered(scene: Scene, settings: RenderSettings, control: RenderControl) =
    Using.resource(scene.prepare(settings, 2))(_.render(control))

  private def rendered(scene: Scene, settings: RenderSettings = RenderSettings()): RenderResult =
    rendered(scene, settings, RenderControl().withThreads(2))

  private val endless = RenderSettings().withTime(Duration.ofHours(1))

  test("a scene's image files are the program's, byte for byte"):
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("scene.pbrt"), LibraryScenes.text())
      def program(name: String) = folder.resolve(s"program.$name")
      val words = Vector("--spp", "4", "--seed", "3", "--aov", "albedo,normal", "-j", "2")
      val files = Vector("exr", "png").flatMap(s => Vector("--outfile", program(s).toString))
      val (code, captured) = Captured.run(("render" +: scene.toString +: words) ++ files*)
      assert(code == 0, captured.err)
      val settings = RenderSettings(samples = 4).withSeed(3).withLayers("albedo", "normal")
      val image = rendered(Candela.read(scene), settings).image
      assert(image.channels.asScala.take(4) == Vector("R", "G", "B", "Albedo.R"))
      for suffix <- Vector("exr", "png") do
        val own = folder.resolve(s"own.$suffix")
        image.save(own)
        assert(Files.readAllBytes(own).toVector == Files.readAllBytes(program(suffix)).toVector)
        assert(Files.readAllBytes(own).toVector == image.bytes(suffix).toVector)

  test("renderings at once have the bytes that each has alone"):
    val texts = Vector("\"path\"", "\"bdpt\"", "\"mlt\" \"integer bootstrapsamples\" 500")
    val scenes = texts.map(i => Candela.parse(LibraryScenes.text(i)))
    val alone = scenes.map(rendered(_).image.values.toVector)
    val start = CyclicBarrier(scenes.size)
    val together = Array.fill(scenes.size)(Vector.empty[Float])
    val threads = scenes.indices.map: i =>
      Thread: () =>
        start.await(60, SECONDS): Unit
        together(i) = rendered(scenes(i)).image.values.toVector
    threads.foreach(_.start())
    threads.foreach(_.join(60_000))
    assert(together.toVector == alone && alone.distinct.size == alone.size)

  test("one job may be rendered several times at once"):
    Using.resource(LibraryScenes.built().scene().prepare(RenderSettings(), 2)): job =>
      val images = Array.fill(2)(Vector.empty[Float])
      val threads = images.indices.map: i =>
        Thread(() => images(i) = job.render(2).image.values.toVector)
      threads.foreach(_.start())
      threads.foreach(_.join(60_000))
      assert(images(0).nonEmpty && images(0) == images(1))
      assert(job.width == 24 && job.height == 16 && job.samplesPerPixel == 8)
      assert(!job.features.isEmpty)

  test("a cancelled rendering returns its image within a second"):
    val stop = Cancellation()
    var asked = 0L
    val listener = new RenderListener:
      override def progressed(progress: Progress): Unit =
        if progress.samples > 1000 && !stop.isCancelled then
          asked = System.nanoTime
          stop.cancel()
    val control = RenderControl().withThreads(2).withListener(listener).withCancellation(stop)
    val result = rendered(LibraryScenes.built().scene(), endless, control)
    // A second is what is promised; a test that others slow down asks that it isn't the hour
    assert(asked > 0 && System.nanoTime - asked < 60_000_000_000L)
    assert(!result.isComplete && result.samplesPerPixel >= 1 && result.image.mean("R") > 0)

  test("closing a job ends its rendering, which returns its image so far"):
    val stop = Cancellation()
    val job = LibraryScenes.built().scene().prepare(endless, 2)
    val listener = new RenderListener:
      override def progressed(progress: Progress): Unit =
        if progress.samples > 1000 then job.close()
        // Where closing does nothing, this ends the test
        if progress.samples > 10_000_000 then stop.cancel()
    val control = RenderControl().withThreads(2).withListener(listener).withCancellation(stop)
    val result = job.render(control)
    assert(!stop.isCancelled && !result.isComplete && result.image.mean("R") > 0)
    assert(intercept[IllegalStateException](job.render(1)).getMessage.contains("closed"))

  test("a text of XML is Mitsuba's, whatever it is called"):
    val text =
      """<scene version="3.0.0"><sensor type="perspective"><film type="hdrfilm">
        |<integer name="width" value="4"/><integer name="height" value="3"/></film></sensor>
        |<emitter type="constant"/></scene>""".stripMargin
    for
      before <- Vector("", "\n ", "\uFEFF", "<?xml version=\"1.0\"?>\n")
      scene <- Vector(
        Candela.parse(before + text),
        Candela.parse(before + text, Path.of("a.pbrt"), ReadSettings())
      )
    do
      assert(!scene.hasErrors, scene.problems)
      assert(rendered(scene).image.mean("G") == 1)
    val wrong = Candela.parse(text.replace("constant", "constan")).problems.get(0)
    assert(wrong.file.get == "scene.xml")

  test("an interrupted thread stops rendering"):
    @volatile var thrown = Option.empty[Throwable]
    @volatile var runs = false
    val thread = Thread: () =>
      val listener = new RenderListener:
        override def started(rendering: LiveRendering): Unit = runs = true
      val control = RenderControl().withThreads(1).withListener(listener)
      try rendered(LibraryScenes.built().scene(), endless, control): Unit
      catch case e: Throwable => thrown = Some(e)
    thread.start()
    Eventually.eventually("rendering")(Option.when(runs)(()))
    thread.interrupt()
    thread.join(60_000)
    assert(thrown.exists(_.isInstanceOf[CancellationException]))

  test("no thread stays behind a closed job"):
    def ours =
      Thread.getAllStackTraces.keySet.asScala.toSet.filter(_.getName.startsWith("candela-"))
    val before = ours
    val job = LibraryScenes.built().scene().prepare(RenderSettings(), 4)
    assert(!job.render(4).image.values.forall(_ == 0f))
    job.close()
    intercept[IllegalStateException](job.render(1))
    // Suites that run at the same time have threads of their own
    val own = ours -- before
    Eventually.eventually("end of all threads")(Option.when(!own.exists(_.isAlive))(()))

  test("the message of an exception is the first error, with its number and that of the others"):
    def message(world: String) =
      val scene = Candela.parse(s"Film \"rgb\" \"float oddity\" 1\nWorldBegin\n$world")
      intercept[SceneException](scene.prepare(RenderSettings())).getMessage
    val unknown = "Shape \"spher\"\n"
    val one = message(unknown)
    assert(one.startsWith("scene.pbrt:3:7: error: ") && one.contains("[E0401]"), one)
    assert(!one.contains(" more "), one)
    assert(message(unknown * 3).endsWith("[E0401], and 2 more errors"), message(unknown * 3))

  test("nothing is printed, no property is set"):
    val (out, err) = (System.out, System.err)
    val bytes = ByteArrayOutputStream()
    val caller = Thread.currentThread

    /** Suites that run at the same time may print. */
    def ours(other: PrintStream): PrintStream =
      val divided = new OutputStream:
        def write(byte: Int): Unit =
          val now = Thread.currentThread
          val isOurs = (now eq caller) || now.getName.startsWith("candela-")
          (if isOurs then bytes else other).write(byte)
      PrintStream(divided, true)
    def properties = System.getProperties.asScala.toMap
      .filter((key, _) => Vector("org.lwjgl", "java.awt", "candela").exists(key.startsWith))
    val before = properties
    System.setOut(ours(out))
    System.setErr(ours(err))
    try
      val scene = Candela.parse(LibraryScenes.text() + "Shape \"spher\"\n")
      assert(!scene.check(RenderSettings()).isEmpty)
      rendered(LibraryScenes.built().scene(), RenderSettings(samples = 2)): Unit
      val _ = Candela.isVectorized
    finally
      System.setOut(out)
      System.setErr(err)
    assert(bytes.size == 0, bytes.toString)
    assert(properties == before)

  test("progress, passes and the image so far are told while a scene is rendered"):
    val passes = Vector.newBuilder[(Int, Double)]
    var last = Option.empty[Progress]
    var live = Option.empty[LiveRendering]
    val listener = new RenderListener:
      override def started(rendering: LiveRendering): Unit = live = Some(rendering)
      override def progressed(progress: Progress): Unit = last = Some(progress)
      override def wantsPasses: Boolean = true
      override def passed(pass: Pass): Unit = passes += ((pass.samples, pass.image.mean("G")))
    val control = RenderControl().withThreads(2).withListener(listener)
    val result = rendered(LibraryScenes.built().scene(), RenderSettings(), control)
    assert(passes.result().map(_._1) == Vector(1, 2, 4, 8))
    assert(passes.result().last._2 == result.image.mean("G"))
    assert(last.exists(p => p.part == 1 && p.samples == p.planned && p.planned == 24 * 16 * 8))
    assert(live.exists(_.image.values.sameElements(result.image.values)))
    assert(result.samples == 24 * 16 * 8 && result.rays > result.samples && result.isComplete)

  test("errors are estimated on request: of the image, and of each value"):
    val scene = LibraryScenes.built(samples = 64).scene()
    val control = RenderControl().withThreads(2).withErrorEstimates
    val result = rendered(scene, RenderSettings(), control)
    val truth = rendered(scene, RenderSettings(samples = 512).withSeed(7)).image.values
    val errors = result.errors.get
    val off = result.image.values.zip(truth).map((a, b) => Math.pow(a - b, 2)).sum
    val told = errors.values.map(e => e.toDouble * e).sum
    // The scene is smooth, and estimates err upwards
    assert(result.error.getAsDouble > 0 && told > off / 2 && told < off * 8, s"$told, $off")
    assert(rendered(scene).error.isEmpty && rendered(scene).errors.isEmpty)

  test("a film that is complete tells the error that it had"):
    TempFolder.use: folder =>
      val scene = LibraryScenes.built(samples = 64).scene()
      val settings = Vector(RenderSettings(), RenderSettings().withError(0.5))
      for (goal, i) <- settings.zipWithIndex do
        val control =
          RenderControl().withThreads(2).withErrorEstimates.withFilm(folder.resolve(s"$i.film"))
        val first = rendered(scene, goal, control)
        val again = rendered(scene, goal, control)
        assert(again.earlierSamplesPerPixel == first.samplesPerPixel && again.isComplete)
        assert(first.error.isPresent && again.error.isPresent, i)
        assert(Math.abs(first.error.getAsDouble - again.error.getAsDouble) < 1e-9)
        assert(first.errors.isPresent && again.errors.isEmpty)

  test("a goal ends a rendering, with whole passes"):
    val scene = LibraryScenes.built().scene()
    val result = rendered(scene, RenderSettings().withError(0.2))
    assert(result.isComplete && result.error.getAsDouble <= 0.2)
    assert(result.samples == 24L * 16 * result.samplesPerPixel)

  test("a film file continues a rendering, to the same bytes"):
    TempFolder.use: folder =>
      val film = folder.resolve("image.film")
      val scene = LibraryScenes.built(samples = 64).scene()
      val stop = Cancellation()
      // By passes: how far the first look at the progress finds it is the machine's affair
      val listener = new RenderListener:
        override def wantsPasses: Boolean = true
        override def passed(pass: Pass): Unit = if pass.samples == 4 then stop.cancel()
      val control = RenderControl().withThreads(2).withFilm(film)
      val first =
        rendered(scene, RenderSettings(), control.withCancellation(stop).withListener(listener))
      assert(!first.isComplete && first.samplesPerPixel == 4 && Files.exists(film))
      val second = rendered(scene, RenderSettings(), control)
      assert(second.isComplete && second.samplesPerPixel == 64 && second.problems.isEmpty)
      assert(second.image.values.sameElements(rendered(scene).image.values))
      val other = LibraryScenes.built(samples = 64).light("infinite", Parameters()).scene()
      val refused = intercept[SceneException](rendered(other, RenderSettings(), control))
      assert(refused.problems.get(0).message.contains("to another rendering"))
      val goal = RenderSettings().withTime(Duration.ofSeconds(1))
      val differing = intercept[SceneException](rendered(scene, goal, control)).problems.get(0)
      assert(differing.message.contains("options none instead of `--sampler progressive"))
      assert(differing.help.get.startsWith("its own settings continue it"))

  test("a full heap is a problem of the scene"):
    val thrown = intercept[SceneException](Problems.thrown(throw OutOfMemoryError()))
    assert(thrown.problems.get(0).number == "E0111")

  test("problems have severity, message, cure and place, and are values"):
    val scene = Candela.parse(LibraryScenes.text() + "Shape \"spher\" \"float radius\" 1\n")
    assert(!scene.hasErrors)
    val problem = scene.check(RenderSettings()).get(0)
    assert(problem.severity == Severity.Error && problem.message.contains("\"spher\""))
    assert(problem.help.get.contains("sphere") && problem.file.get == "scene.pbrt")
    assert(problem.line == LibraryScenes.text().linesIterator.size + 1 && problem.column == 7)
    assert(problem.toString.startsWith(s"scene.pbrt:${problem.line}:7: error: "))
    val none = Candela.read(Path.of("/nowhere/scene.pbrt"))
    assert(none.hasErrors && none.dialect.isEmpty && none.files.isEmpty)
    assert(none.problems.get(0).message == "no such scene file: `/nowhere/scene.pbrt`")
    assert(intercept[SceneException](none.prepare(RenderSettings())).problems.size == 1)
    assert(intercept[SceneException](none.edit()).problems.size == 1)

  test("scenes of Mitsuba are read from texts, too"):
    val scene = Candela.parse(
      LibrarySuite.mitsuba,
      Path.of("scene.xml"),
      ReadSettings().withDefine("spp", "2")
    )
    assert(scene.problems.isEmpty && scene.dialect == "mitsuba", scene.problems)
    assert(rendered(scene).image.mean("R") > 0)
    val unknown = Candela.parse(
      LibrarySuite.mitsuba,
      Path.of("scene.xml"),
      ReadSettings().withDefine("samples", "2")
    )
    assert(unknown.hasErrors)

  test("a time limit ends rendering, too, and its message names it"):
    val how = ReadSettings().withSandbox.withTimeLimit(Duration.ofMillis(1500))
    val scene = Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), how)
    // Longer than the limit, yet no hang without it
    val long = RenderSettings().withTime(Duration.ofSeconds(30))
    val late = refused(rendered(scene, long))
    assert(late.number == "E0110" && late.message.contains("the time limit of 1.5 s"), late)
    // Which begins with each scene
    assert(!Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), how).hasErrors)

  test("constants of enums are there for Java, also if Scala code uses them first"):
    val used = Vector[AnyRef](Severity.Error, SceneSetting.Film, TextureValues.Float)
    for constant <- used do
      val field = constant.getClass.getField(constant.toString)
      assert(field.get(null) eq constant)

  test("a picture in memory keeps alpha"):
    val text = LibraryScenes.text()
    val image = rendered(Candela.parse(text), RenderSettings(samples = 1).withLayers("alpha")).image
    val picture = ImageIO.read(ByteArrayInputStream(image.bytes("png")))
    assert(picture.getColorModel.hasAlpha)

  test("limits are set as those of the program"):
    def exceeded(name: String, value: String): Problem =
      val how = ReadSettings().withSandbox.withLimit(name, value)
      val scene = Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), how)
      refused(scene.prepare(RenderSettings()))
    assert(exceeded("pixels", "0.1k").message.contains("at most 100 are allowed"))
    assert(exceeded("samples", "2").number == "E0110")
    assert(refused(ReadSettings().withLimit("pixel", "2")).help.get.contains("pixels"))
    assert(refused(ReadSettings().withLimit("bytes", "2 metres")).help.get.contains("500MB"))
    val lifted = ReadSettings().withLimit("pixels", "1").withLimit("pixels", "none")
    val scene = Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), lifted)
    assert(scene.check(RenderSettings()).isEmpty)

  test("options of reading scenes are set where scenes are read"):
    for
      (name, text) <- Vector("a.pbrt" -> LibraryScenes.text(), "a.xml" -> LibrarySuite.mitsuba)
    do
      def width(how: ReadSettings) =
        val scene = Candela.parse(text, Path.of(name), how)
        Using.resource(scene.prepare(RenderSettings(), 1))(_.width)
      assert(width(ReadSettings().withOption("resolution", "50%")) * 2 == width(ReadSettings()))
    for (name, value) <- Vector("resolution" -> "25%", "sensor" -> "1", "light" -> "sky") do
      val problem = refused(RenderSettings().withOption(name, value))
      assert(problem.help.get == "it belongs to ReadSettings", name)
      assert(ReadSettings().withOption(name, value).toString.contains(s"--$name "))
    assert(refused(RenderSettings().withOption("keep-going")).help.get.contains("ReadSettings"))
    val other = refused(ReadSettings().withOption("seed", "0"))
    assert(other.help.get == "it belongs to RenderSettings")
    for (name, value) <- Vector("sensor" -> "all", "at" -> "0:1:2") do
      assert(refused(ReadSettings().withOption(name, value)).message.contains("several images"))

  test("excerpts of a text are of the text, not of a file of its name"):
    TempFolder.use: folder =>
      for (name, text) <- Vector(
          "a.pbrt" -> (LibraryScenes.text() + "Shape \"sphere\" \"string alpha\" \"no\"\n"),
          "a.xml" -> LibrarySuite.mitsuba.replace("\"sphere\"", "\"spher\"")
        )
      do
        val file = folder.resolve(name)
        val lines = text.linesIterator.toVector
        val secret = Files.writeString(file, lines.map(_ => "secret " * 20).mkString("\n"))
        val scene = Candela.parse(text, secret, ReadSettings())
        val problems = scene.check(RenderSettings()).asScala
        assert(problems.nonEmpty)
        for p <- problems do assert(p.excerpt.get == lines(p.line - 1), p)
        val limited = Candela.parse(text, secret, ReadSettings().withLimit("pixels", "1"))
        for p <- limited.check(RenderSettings()).asScala do
          assert(!p.excerpt.orElse("").contains("secret"), p)

  test("a missing text is an error of its caller"):
    assert(intercept[NullPointerException](Candela.parse(null)).getMessage == "text")

  private def refused(body: => Any): Problem = intercept[SceneException](body).problems.get(0)

  test("settings that mean nothing say what they may be"):
    assert(refused(RenderSettings().withLayers("albdo")).help.get.contains("albedo"))
    assert(refused(RenderSettings().withOption("firefly", "keep")).message
      == "unknown setting `firefly`")
    assert(refused(RenderSettings().withOption(
      "seed",
      "x"
    )).message == "`seed` must be a whole number, found `x`")
    assert(refused(
      RenderSettings().withOption("seed")
    ).message == "setting `seed` takes a value, found none")
    assert(refused(RenderSettings(samples = 0)).message.contains("`spp`"))
    assert(refused(RenderSettings().withError(0)).message == "the error must be above 0, found 0.0")
    assert(refused(RenderSettings().withError(10)).message.contains("below 1, which is 100 %"))
    assert(refused(ReadSettings().withDialect("v5")).help.get == "expected v2, v3 or v4")
    assert(
      refused(RenderControl().withThreads(0)).message == "`threads` must be at least 1, found 0"
    )
    val two = RenderSettings(samples = 2).withOption("color", "spectral")
    assert(two == RenderSettings(samples = 2).withOption("color", "spectral"))
    assert(two.words.asScala == Vector("--spp", "2", "--color", "spectral"))

object LibrarySuite:
  private val mitsuba =
    """<scene version="3.0.0">
      |  <default name="spp" value="4"/>
      |  <integrator type="path"/>
      |  <sensor type="perspective">
      |    <transform name="to_world"><lookat origin="0,0,-4" target="0,0,0" up="0,1,0"/>
      |    </transform>
      |    <film type="hdrfilm"><integer name="width" value="16"/>
      |      <integer name="height" value="12"/>
      |    </film>
      |    <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
      |  </sensor>
      |  <emitter type="constant"/>
      |  <shape type="sphere"/>
      |</scene>
      |""".stripMargin
