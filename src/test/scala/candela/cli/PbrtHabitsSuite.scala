package candela.cli

import candela.cli.rendering.PartialImages
import candela.image.{Image, ImageFiles}
import candela.job.SceneLoader
import candela.measure.Metrics
import candela.render.{RenderControl, Renderer}
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*

import org.scalatest.funsuite.AnyFunSuite

/** What the options do that pbrt's command lines have, too. */
final class PbrtHabitsSuite extends AnyFunSuite:

  /** A light and a dark triangle, which share an edge across the pixels, under an even sky. */
  private def scene(folder: Path, statements: String = ""): String =
    val text =
      s"""$statements
         |LookAt 0 0 5  0 0 0  0 1 0
         |Camera "orthographic" "float screenwindow" [-1 1 -1 1]
         |Sampler "independent" "integer pixelsamples" 8
         |Film "rgb" "integer xresolution" 16 "integer yresolution" 12
         |Integrator "path" "integer maxdepth" 1
         |WorldBegin
         |LightSource "infinite" "rgb L" [1 1 1]
         |Material "diffuse" "rgb reflectance" [.8 .8 .8]
         |Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-2 -2 0  2 -1.4 0  -2 2.1 0]
         |Material "diffuse" "rgb reflectance" [.1 .1 .1]
         |Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [2 2 0  -2 2.1 0  2 -1.4 0]
         |""".stripMargin
    Files.writeString(folder.resolve("s.pbrt"), text)
    s"$folder/s.pbrt"

  private def run(words: String*): Captured =
    val captured = Captured()
    assert(Main.run(words, captured.terminal) == 0, captured.err)
    captured

  private def rendered(folder: Path, statements: String, words: String*): Image =
    val file = s"$folder/a.exr"
    val _ = run((Vector(scene(folder, statements), "--outfile", file, "--quiet") ++ words)*)
    ImageFiles.read(Path.of(file))

  /** Pixels that are neither light nor dark. */
  private def blended(image: Image): Int =
    (0 until image.width * image.height).count: i =>
      image.data(3 * i) > 0.2f && image.data(3 * i) < 0.6f

  test("samples at pixel centres see one triangle each, by option of scene or command line"):
    TempFolder.use: folder =>
      assert(blended(rendered(folder, "")) > 5)
      assert(blended(rendered(folder, "", "--disable-pixel-jitter")) == 0)
      assert(blended(rendered(folder, "Option \"disablepixeljitter\" true")) == 0)

  test("--pixelbounds and --pixel render these pixels alone, as they are in the whole image"):
    TempFolder.use: folder =>
      // A box filter: pixels are then independent of the window
      val whole = rendered(folder, "PixelFilter \"box\"")
      val part = rendered(folder, "PixelFilter \"box\"", "--pixelbounds", "3,9,2,5")
      assert((part.width, part.height) == (6, 3))
      for y <- 0 until 3; x <- 0 until 6; c <- 0 until 3 do
        assert(part(x, y, c) == whole(x + 3, y + 2, c))
      val one = rendered(folder, "PixelFilter \"box\"", "--pixel", "8,6")
      assert((one.width, one.height) == (1, 1))
      assert(one(0, 0, 1) == whole(8, 6, 1))
      val beyond = rendered(folder, "PixelFilter \"box\"", "--pixelbounds", "10,99,-3,4")
      assert((beyond.width, beyond.height) == (6, 4))

  test("a window outside the image is an error that says so"):
    TempFolder.use: folder =>
      val captured = Captured()
      val words = Vector(scene(folder), "--outfile", s"$folder/a.exr", "--pixelbounds", "20,30,0,1")
      assert(Main.run(words, captured.terminal) == 1)
      assert(captured.err.contains("pixels 20,30,0,1 are outside 16×12"), captured.err)

  test("--pixelmaterial says what the centre of a pixel shows"):
    TempFolder.use: folder =>
      val light = run(scene(folder), "--pixelmaterial", "2,10").out
      assert(
        light.contains("diffuse s.pbrt:9:") && light.contains("trianglemesh s.pbrt:10:"),
        light
      )
      assert(light.linesIterator.exists(l => l.contains("albedo") && l.contains("0.8")), light)
      assert(run(scene(folder), "--pixelmaterial", "1,1").out.contains("diffuse s.pbrt:11:"))
      assert(!Files.exists(folder.resolve("pbrt.exr")))

  test("the errors of all passes are written, by option of scene or command line"):
    TempFolder.use: folder =>
      val reference = s"$folder/r.exr"
      val _ = run(scene(folder), "--outfile", reference, "--spp", "256", "--quiet")
      def lines(name: String) =
        val found = Files.readAllLines(folder.resolve(name)).asScala.toVector
        found.map(_.split(", ")).map(w => w(0).toInt -> w(1).toDouble)
      val image = rendered(
        folder,
        "",
        "--mse-reference-image",
        reference,
        "--mse-reference-out",
        s"$folder/e.txt"
      )
      val errors = lines("e.txt")
      assert(errors.map(_._1) == Vector(1, 2, 4, 8))
      val expected = Metrics.compare(image, ImageFiles.read(Path.of(reference))).mse
      // The image was rounded to half floats
      assert(Math.abs(errors.last._2 - expected) < 0.01 * expected)
      assert(errors.head._2 > 2 * errors.last._2)
      val options =
        s"""Option "msereferenceimage" "$reference" Option "msereferenceout" "$folder/f.txt""""
      val _ = rendered(folder, options)
      assert(lines("f.txt") == errors)

  test("one of the two options of errors needs the other"):
    TempFolder.use: folder =>
      val captured = Captured()
      val words = Vector("check", scene(folder, "Option \"msereferenceout\" \"e.txt\""))
      assert(Main.run(words, captured.terminal) == 1)
      assert(captured.err.contains("option `msereferenceout` needs `msereferenceimage`"))

  test("partial images are written before the last, which is the same as without them"):
    TempFolder.use: folder =>
      val plain = rendered(folder, "")
      val plan = SceneLoader.FromFile.load(scene(folder), RenderSettings(), BuildControl()).plan
      var written = 0
      val partly = PartialImages(_ => written += 1)
      val _ = Renderer.render(plan, RenderControl(threads = 1, listener = partly))
      assert(written == 3) // at 1, 2 and 4 of 8 samples
      assert(rendered(folder, "", "--write-partial-images").data.sameElements(plain.data))

  test("--toply and --cat print the scene in its own dialect"):
    TempFolder.use: folder =>
      val printed = run("--format", scene(folder)).out
      assert(printed.contains("Shape \"trianglemesh\"") && printed.contains("Film \"rgb\""))

  test("each world of a file is an image: of its Film, or by number"):
    TempFolder.use: folder =>
      def world(color: String, name: String) =
        s"""Film "image" "integer xresolution" 4 "integer yresolution" 3 "string filename" "$name"
           |Sampler "random" "integer pixelsamples" 1
           |Camera "perspective"
           |WorldBegin
           |LightSource "infinite" "rgb L" [$color]
           |WorldEnd
           |""".stripMargin
      val scene = folder.resolve("two.pbrt")
      val text = world("1 0 0", s"$folder/a.exr") + world("0 1 0", s"$folder/b.exr")
      Files.writeString(scene, text)
      def isColored(name: String, channel: Int) =
        val image = ImageFiles.read(folder.resolve(name))
        (0 until 3).forall(c => image(0, 0, c) == (if c == channel then 1f else 0f))
      val _ = run(s"$scene", "--quiet")
      assert(isColored("a.exr", 0) && isColored("b.exr", 1))
      val _ = run(s"$scene", "--quiet", "--outfile", s"$folder/w%02d.exr")
      assert(isColored("w01.exr", 0) && isColored("w02.exr", 1))
      val captured = Captured()
      val code = Main.run(Seq(s"$scene", "--outfile", s"$folder/x.exr"), captured.terminal)
      assert(code == 1 && captured.err.contains("has several worlds, each an image;"))
      assert(!Files.exists(folder.resolve("x.exr")))
