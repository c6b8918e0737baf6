package candela.cli.commands

import candela.base.Version
import candela.diagnostics.{Code, Problem, SceneError, SourcePos}
import candela.aov.Layer
import candela.cli.{Captured, Main}
import candela.cli.terminal.Interrupts
import candela.color.Rgb
import candela.image.ImageFiles
import candela.job.{Denoising, Prepared, SceneLoader}
import candela.render.{Cancellation, RenderPlan, TinyPlan}
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class RenderCommandSuite extends AnyFunSuite:
  private val gray = Rgb(0.5f, 0.25f, 2f)

  /** Knows scenes by name; writes nothing but where it is told. */
  private final class Known(scenes: (String, RenderPlan)*) extends SceneLoader:
    var loaded = Vector.empty[String]
    def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
      loaded :+= scene
      def unknown = SceneError(Problem.general(Code.NoSuchScene, s"no $scene"))
      val plan = scenes.toMap.getOrElse(scene, throw unknown)
      val warning = Problem.warning(Code.Undefined, SourcePos(scene, 3, 1), "planted")
      Prepared(SceneDescription(Dialect.V3), plan, Vector(warning, warning), 0.5, 0.25)

  private def plan(file: Path) = TinyPlan(filename = file.toString)((_, _) => gray)

  private def run(captured: Captured, loader: SceneLoader, args: String*): Int =
    Main.run(args, captured.terminal, loader)

  test("the scene's EXR and a PNG beside it are written, and one line says so"):
    TempFolder.use: folder =>
      val captured = Captured()
      val code = run(captured, Known("s.pbrt" -> plan(folder.resolve("a.exr"))), "s.pbrt")
      assert(code == 0)
      assert(TempFolder.names(folder) == Set("a.exr", "a.png"))
      val exr = ImageFiles.read(folder.resolve("a.exr"))
      assert((exr.width, exr.height) == (40, 27))
      assert((exr(39, 26, 0), exr(39, 26, 1), exr(39, 26, 2)) == (0.5f, 0.25f, 2f))
      val start = s"wrote $folder/a.exr, $folder/a.png  40x27, 5 spp, "
      assert(captured.out.startsWith(start) && captured.out.contains(" rays/s"))
      assert(captured.out.linesIterator.size == 1)
      assert(captured.err == "s.pbrt:3:1: warning: planted [E0403]\n")

  test("with --outfile exactly those files are written"):
    TempFolder.use: folder =>
      val loader = Known("s.pbrt" -> plan(folder.resolve("a.exr")))
      assert(run(Captured(), loader, "s.pbrt", "--outfile", s"$folder/b.png") == 0)
      assert(TempFolder.names(folder) == Set("b.png"))

  test("tone curves change pictures alone: the EXR keeps the light"):
    TempFolder.use: folder =>
      val loader = Known("s.pbrt" -> plan(folder.resolve("x.exr")))
      val files = s"$folder/a.exr,$folder/a.png"
      val options = Seq("--outfile", files, "--exposure", "-2", "--thumbnail", "blocks")
      val captured = Captured()
      assert(run(captured, loader, "s.pbrt" +: options*) == 0)
      val exr = ImageFiles.read(folder.resolve("a.exr"))
      assert((exr(3, 2, 0), exr(3, 2, 1), exr(3, 2, 2)) == (0.5f, 0.25f, 2f))
      val png = ImageFiles.read(folder.resolve("a.png")).linear
      for (wanted, c) <- Vector(0.125f, 0.0625f, 0.5f).zipWithIndex do
        // Half a code of 8 bits: 0.003 of light at 0.5
        assert(Math.abs(png(3, 2, c) - wanted) < 0.005f)
      assert(captured.out.count(_ == '▀') == 40 * 14)
      def has(file: String) =
        Files.readString(folder.resolve(file), java.nio.charset.StandardCharsets.ISO_8859_1)
          .contains("-2.00 stops")
      assert(has("a.png") && !has("a.exr"))

  test("a thumbnail for an unknown terminal is refused before anything is loaded"):
    TempFolder.use: folder =>
      val captured = Captured()
      val loader = Known("s.pbrt" -> plan(folder.resolve("x.exr")))
      assert(run(captured, loader, "s.pbrt", "--thumbnail", "auto") == 1)
      assert(loader.loaded.isEmpty && captured.err.startsWith("error: no terminal known"))

  test("layers go into an EXR; without one they are refused before anything is rendered"):
    TempFolder.use: folder =>
      val scene = folder.resolve("s.pbrt")
      val film = "Film \"rgb\" \"integer xresolution\" 6 \"integer yresolution\" 4"
      val _ = Files.writeString(scene, s"$film\nWorldBegin\nLightSource \"infinite\"")
      def render(words: String*) =
        val captured = Captured()
        (Main.run(scene.toString +: words, captured.terminal), captured)
      assert(render("--aov", "depth,samples", "--outfile", s"$folder/a.exr,$folder/a.png")._1 == 0)
      val names = ImageFiles.read(folder.resolve("a.exr")).channelNames
      assert(names == Vector("R", "G", "B", "Z", "samples"))
      val (refused, captured) = render("--film", "gbuffer", "--outfile", s"$folder/b.png")
      assert(refused == 1 && captured.err.contains("AOVs need .exr or .npz output"))

  test("pictures that keep alpha have colours that are not multiplied by it, others refuse it"):
    TempFolder.use: folder =>
      val scene = folder.resolve("s.pbrt")
      val film = "Film \"rgb\" \"integer xresolution\" 6 \"integer yresolution\" 6"
      val camera = "LookAt 0 0 -4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 45"
      val emitter = "AreaLightSource \"diffuse\" \"rgb L\" [.5 .5 .5] Shape \"sphere\""
      val _ = Files.writeString(scene, s"$film\n$camera\nWorldBegin $emitter")
      def render(words: String*) =
        val captured = Captured()
        (Main.run(scene.toString +: words, captured.terminal), captured)
      val files = Seq("a.exr", "a.png", "a.tga").map(folder.resolve)
      assert(render("--aov", "alpha", "--outfile", files.mkString(","))._1 == 0)
      val Seq(exr, png, tga) = files.map(ImageFiles.read(_).linear): @unchecked
      assert(Seq(exr, png, tga).forall(_.channelNames == Vector("R", "G", "B", "A")))
      val alphas = (0 until 36).map(i => exr.data(4 * i + 3))
      assert(alphas.exists(a => a > 0.1f && a < 0.9f) && alphas.contains(0f))
      for i <- 0 until 36; picture <- Seq(png, tga) do
        // Half a code, and that of the half-precision file
        assert(Math.abs(picture.data(4 * i + 3) - alphas(i)) < 0.6f / 255)
        val right = if alphas(i) == 0f then 0f else exr.data(4 * i) / alphas(i)
        assert(Math.abs(picture.data(4 * i) - right) < 0.01f, s"pixel $i")
      val (short, _) = render("--film", "rgba", "--outfile", s"$folder/b.png")
      assert(short == 0 && ImageFiles.read(folder.resolve("b.png")).channelNames.contains("A"))
      val (refused, captured) = render("--aov", "alpha", "--outfile", s"$folder/b.jpg")
      assert(refused == 1 && captured.err.contains("alpha needs .exr, .png, .tga or .npz output"))

  test("layers have the precision asked for; identifiers have 32 bits, and a legend"):
    TempFolder.use: folder =>
      val scene = folder.resolve("s.pbrt")
      val film = "Film \"rgb\" \"integer xresolution\" 6 \"integer yresolution\" 4"
      val camera = "LookAt 0 0 -4  0 0 0  0 1 0 Camera \"perspective\""
      val world = "WorldBegin LightSource \"infinite\" Shape \"sphere\""
      val _ = Files.writeString(scene, s"$film\n$camera\n$world")
      def image(aov: String) =
        val file = folder.resolve("a.exr")
        assert(Main.run(
          Seq(scene.toString, "--aov", aov, "--outfile", file.toString),
          Captured().terminal
        ) == 0)
        (
          ImageFiles.read(file),
          Files.readString(file, java.nio.charset.StandardCharsets.ISO_8859_1)
        )
      def isExact(image: candela.image.Image, channel: String) =
        val c = image.channelNames.indexOf(channel)
        (0 until 24).exists: i =>
          val bits = java.lang.Float.floatToRawIntBits(image.data(i * image.channels + c))
          (bits & 0x1fff) != 0
      val (plain, legend) = image("depth,cryptoobject")
      assert(!isExact(plain, "Z") && isExact(plain, "CryptoObject00.R"))
      assert(legend.contains("{\"sphere s.pbrt:3:") && legend.contains("MurmurHash3_32"))
      assert(isExact(image("depth:float")._1, "Z") && !isExact(image("depth:half")._1, "Z"))
      val group = "Combined_infinite_3.R"
      assert(isExact(image("lights:float")._1, group) && !isExact(image("lights")._1, group))

  private def needsDenoiser(): Unit =
    try candela.image.Oidn.load(): Unit
    catch
      case e: candela.image.ImageError =>
        println(s"RenderCommandSuite: skipped: ${e.getMessage}")
        cancel(e.getMessage)

  test("--denoise keeps the colour space of the image"):
    needsDenoiser()
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val scene = folder.resolve("s.pbrt")
      val _ = Files.writeString(
        scene,
        """ColorSpace "rec2020"
        Film "rgb" "integer xresolution" 16 "integer yresolution" 16
        Camera "perspective" WorldBegin
        LightSource "infinite" "rgb L" [.9 .1 .1] """
      )
      val words = Seq(scene.toString, "--spp", "1", "--denoise", "--outfile", file.toString)
      assert(Main.run(words, Captured(environment = sys.env).terminal) == 0)
      val image = ImageFiles.read(file)
      assert(!image.colorSpace.isSrgb)
      for (c, i) <- Vector("R", "G", "B").zipWithIndex do
        val (noisy, denoised) = (
          image.channelNames.indexOf(c),
          image.channelNames.indexOf(
            Denoising.Channels(i)
          )
        )
        // A network denoises: it returns even a flat colour only to a percent or two
        assert(Math.abs(image(8, 8, denoised) - image(8, 8, noisy)) < 0.02f, c)

  test("--denoise adds a layer, marks it as biased, and pictures show it"):
    needsDenoiser()
    TempFolder.use: folder =>
      val scene = folder.resolve("s.pbrt")
      val film = "Film \"rgb\" \"integer xresolution\" 48 \"integer yresolution\" 32"
      val camera = "LookAt 0 0 -4  0 0 0  0 1 0 Camera \"perspective\""
      val emitter = "AttributeBegin Translate 2 3 0 AreaLightSource \"diffuse\" " +
        "Shape \"sphere\" \"float radius\" .2 AttributeEnd"
      val _ = Files.writeString(scene, s"$film\n$camera\nWorldBegin\n$emitter Shape \"sphere\"")
      def run(args: String*) =
        val captured = Captured(environment = sys.env)
        assert(Main.run(scene.toString +: args, captured.terminal) == 0)
        captured.out
      val _ = run("--spp", "512", "--outfile", s"$folder/r.exr", "--quiet")
      val said = run(
        "--spp",
        "4",
        "--denoise",
        "--outfile",
        s"$folder/a.exr,$folder/a.png",
        "--reference",
        s"$folder/r.exr",
        "--report",
        s"$folder/r.json,$folder/r.html"
      )
      val exr = ImageFiles.read(folder.resolve("a.exr"))
      val layers = Layer.denoising.flatMap(_.channels) ++ Denoising.Channels
      assert(exr.channelNames.toSet == (candela.image.Image.RgbNames ++ layers).toSet)
      val line = "error  (\\S+) % noisy, (\\S+) % noisy in the same time, (\\S+) % denoised".r
      val errors = line.findFirstMatchIn(said).get
      val Vector(before, sameTime, after) = errors.subgroups.map(_.toDouble).toVector: @unchecked
      assert(after < before / 1.7 && sameTime < before && sameTime > 0, said)
      val report = Files.readString(folder.resolve("r.json"))
      assert(report.contains(errors.matched.drop("error  ".length)))
      assert(report.contains("\"name\": \"denoise\""))
      assert(Files.readString(folder.resolve("r.html")).contains("4 samples, denoised"))
      val png = ImageFiles.read(folder.resolve("a.png")).linear
      val shown = Denoising.displayed(exr)
      assert(png.data.indices.forall(i => Math.abs(png.data(i) - shown.data(i).min(1f)) < 0.01f))
      val text =
        Files.readString(folder.resolve("a.exr"), java.nio.charset.StandardCharsets.ISO_8859_1)
      assert(text.contains("Open Image Denoise 2") && text.contains("Denoised.R, Denoised.G"))
      // A picture alone needs no EXR for the layers
      val _ = run("--spp", "1", "--denoise", "--outfile", s"$folder/b.png")

  test("--denoise without the library fails before anything is loaded"):
    TempFolder.use: folder =>
      val captured = Captured(environment = Map("CANDELA_OIDN" -> folder.toString))
      val loader = Known("s.pbrt" -> plan(folder.resolve("x.exr")))
      assert(run(captured, loader, "s.pbrt", "--denoise") == 1)
      assert(loader.loaded.isEmpty && captured.err.contains("pip install pyoidn"))

  test("the EXR says of what it is an image"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val _ = run(Captured(), Known("s.pbrt" -> plan(file)), "s.pbrt", "--seed", "7")
      val bytes = String(Files.readAllBytes(file), "ISO-8859-1")
      val wanted =
        Vector("software", s"Candela ${Version.current}", "scene", "s.pbrt", "dialect", "v3") ++
          Vector("samplesPerPixel", "seed", "integrator", "formula")
      for text <- wanted do assert(bytes.contains(text), text)

  test("two renderings of a scene are the same files, unless the time is to be stored"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      def files(words: String*) =
        val _ = run(Captured(), Known("s.pbrt" -> plan(file)), "s.pbrt" +: words*)
        Vector("a.exr", "a.png").map(name => Files.readAllBytes(folder.resolve(name)).toVector)
      val first = files("--nthreads", "1")
      assert(files("--nthreads", "3") == first)
      val timed = files("--store-time")
      assert(timed(0) != first(0) && timed(1) != first(1))
      assert(String(timed(0).toArray, "ISO-8859-1").contains("renderSeconds"))

  test("--quiet prints nothing when all is well"):
    TempFolder.use: folder =>
      val captured = Captured()
      val loader = Known("s.pbrt" -> plan(folder.resolve("a.exr")))
      val code = run(captured, loader, "--quiet", "s.pbrt")
      assert((code, captured.out, captured.err) == (0, "", ""))

  test("--verbose adds the phases and what the scene is made of"):
    TempFolder.use: folder =>
      val captured = Captured()
      val loader = Known("s.pbrt" -> plan(folder.resolve("a.exr")))
      assert(run(captured, loader, "--verbose", "s.pbrt") == 0)
      assert(captured.err.contains("parse 0.50 s, build 0.25 s, render "))
      assert(captured.err.contains("  integrator  formula\n"))

  test("a bad scene does not stop the others, but the exit code tells"):
    TempFolder.use: folder =>
      val captured = Captured()
      val loader = Known("good.pbrt" -> plan(folder.resolve("a.exr")))
      assert(run(captured, loader, "bad.pbrt", "good.pbrt") == 1)
      assert(captured.err.startsWith("error: no bad.pbrt [E0101]\n"))
      assert(TempFolder.names(folder) == Set("a.exr", "a.png"))

  test("two scenes do not overwrite each other's image"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val captured = Captured()
      val loader = Known("one.pbrt" -> plan(file), "two.pbrt" -> plan(file))
      assert(run(captured, loader, "one.pbrt", "two.pbrt") == 1)
      assert(captured.err.contains("the image of `two.pbrt` would overwrite that of `one.pbrt`"))

  test("where the image can't go, the scene is not even read"):
    TempFolder.use: folder =>
      val loader = Known("s.pbrt" -> plan(folder.resolve("a.exr")))
      val captured = Captured()
      assert(run(captured, loader, "s.pbrt", "--outfile", s"$folder/none/b.exr") == 1)
      val message = s"error: can't write `$folder/none/b.exr`: no such folder"
      assert(captured.err.startsWith(message) && captured.err.contains(" make the folder, or "))
      assert(loader.loaded.isEmpty)

  test("a rendering that fails leaves the image that was there, and no other file"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a.exr"), "precious")
      val failing = TinyPlan(filename = file.toString): (where, _) =>
        if where.sample == 4 then throw IllegalStateException("planted") else gray
      val captured = Captured()
      assert(run(captured, Known("s.pbrt" -> failing), "s.pbrt") == 3)
      assert(Files.readString(file) == "precious")
      assert(TempFolder.names(folder) == Set("a.exr"))
      val message = "error: this is a bug in Candela: java.lang.IllegalStateException: planted"
      assert(captured.err.contains(message))
      assert(captured.out.isEmpty)

  test("samples that are no light are told"):
    TempFolder.use: folder =>
      val sick = TinyPlan(filename = folder.resolve("a.exr").toString): (where, _) =>
        if where.x == 3 && where.sample == 2 then Rgb(Float.NaN, 0f, 0f) else gray
      val captured = Captured()
      assert(run(captured, Known("s.pbrt" -> sick), "s.pbrt") == 0)
      assert(captured.err.contains(
        "warning: 27 samples discarded: NaN or infinite, " +
          "the first at pixel (3, 0), sample 2; " +
          "trace it with `candela render --pixel 3,0 --sample 2 --debug`"
      ))
      // 27 of the image's samples are more than one in a thousand
      assert(captured.out.trim.linesIterator.toVector.last.contains("the image is too dark: "))

  test("the last line leaves out a few discarded samples"):
    TempFolder.use: folder =>
      val sick = TinyPlan(filename = folder.resolve("a.exr").toString): (where, _) =>
        if where.x == 3 && where.y == 0 && where.sample == 2 then Rgb(Float.NaN, 0f, 0f) else gray
      val captured = Captured()
      assert(run(captured, Known("s.pbrt" -> sick), "s.pbrt") == 0)
      assert(captured.err.contains("warning: 1 sample discarded"))
      assert(!captured.out.contains("too dark"))

  test("--debug tells the path of one sample and writes nothing"):
    TempFolder.use: folder =>
      val sick = TinyPlan(filename = folder.resolve("a.exr").toString): (where, _) =>
        if where.x == 3 && where.sample == 2 then Rgb(Float.NaN, 0f, 0f) else gray
      def told(words: String*) =
        val captured = Captured()
        val code = run(captured, Known("s.pbrt" -> sick), ("--debug" +: words :+ "s.pbrt")*)
        (code, captured.out + captured.err)
      val (_, bad) = told("--pixel", "3,0", "--sample", "2")
      assert(bad.contains("pixel (3, 0), sample 2") && bad.contains("discarded"))
      assert(told("--pixel", "4,0")._2.contains("contributes rgb("))
      assert(told("--pixel", "400,0") match
        case (1, words) => words.contains("400,0 is outside the image")
        case _ => false)
      assert(told()._1 == 2 && told("--pixel", "a,b")._1 == 2)
      assert(TempFolder.names(folder).isEmpty)

  /** Ctrl-C that comes when a certain sample is taken. */
  private final class AtSample extends Interrupts:
    private var current = Cancellation()
    def press(): Unit = current.request()
    def during[A](cancellation: Cancellation)(body: => A): A =
      current = cancellation
      body

  private val none = "less than 1 of 5 samples per pixel, error unknown: too few samples\n"

  test("an image that is interrupted before each pixel has a sample is written too, and says so"):
    TempFolder.use: folder =>
      val interrupts = AtSample()
      val plan = TinyPlan(filename = folder.resolve("a.png").toString): (_, _) =>
        interrupts.press()
        gray
      val captured = Captured(interrupts = interrupts)
      assert(run(captured, Known("s.pbrt" -> plan), "s.pbrt", "--nthreads", "1") == 130)
      assert(captured.out == s"interrupted: wrote $folder/a.png with $none")

  test("a finished image is kept if its next rendering is interrupted before the first sample"):
    TempFolder.use: folder =>
      val old = Files.write(folder.resolve("a.exr"), Array[Byte](1, 2, 3))
      val interrupts = AtSample()
      val plan = TinyPlan(filename = old.toString): (_, _) =>
        interrupts.press()
        gray
      val captured = Captured(interrupts = interrupts)
      assert(run(captured, Known("s.pbrt" -> plan), "s.pbrt", "--nthreads", "1") == 130)
      assert(Files.readAllBytes(old).sameElements(Array[Byte](1, 2, 3)))
      assert(captured.out == s"interrupted: wrote $folder/a.png with $none")
      assert(captured.err.contains(s"interrupted: kept $old: the new image has less than 1 sample"))

  test("an interrupted rendering is written as far as it is; other scenes are left"):
    TempFolder.use: folder =>
      val interrupts = AtSample()
      val file = folder.resolve("a.exr")
      val endless = TinyPlan(spp = 1_000_000, filename = file.toString): (where, _) =>
        if where.sample == 8 then interrupts.press()
        gray
      val captured = Captured(interrupts = interrupts)
      val loader = Known("s.pbrt" -> endless, "t.pbrt" -> plan(folder.resolve("t.exr")))
      assert(run(captured, loader, "s.pbrt", "t.pbrt", "--nthreads", "1") == 130)
      assert(captured.out == s"interrupted: wrote $folder/a.exr, $folder/a.png " +
        "with 8 of 1000000 samples per pixel, error 0 %\n")
      val image = ImageFiles.read(file)
      assert((image(39, 26, 0), image(0, 0, 2)) == (0.5f, 2f))
      assert(loader.loaded == Vector("s.pbrt"))
