package candela.cli.options

import candela.build.recipe.Dialects
import candela.cli.{Captured, Main}
import candela.cli.terminal.ExitCode
import candela.film.PixelBounds
import candela.scenefile.Dialect
import candela.settings.{OutputSettings, RenderRegion, RenderSettings}

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*

import org.scalatest.funsuite.AnyFunSuite

/** Command lines of pbrt mean here what they mean there. */
final class PbrtOptionsSuite extends AnyFunSuite:

  /** Version and name of each option: what `pbrt --help` prints, and v4's of GPUs. */
  private val known: Set[(String, String)] =
    val file = Path.of("src/test/resources/candela/cli/options/pbrt-options.tsv")
    Files.readAllLines(file).asScala.map(_.split('\t')).map(w => w(0) -> w(1)).toSet

  test("the table has every option of each version, and no others"):
    val told =
      for o <- PbrtOptions.all; d <- Dialect.ofPbrt if o.dialects(d)
      yield Dialects.name(d) -> o.name
    assert((known -- told).isEmpty, "missing")
    assert((told.toSet -- known).isEmpty, "unknown to pbrt")

  test("options that are the same here are options of rendering"):
    val ours = CommandTable.of(Command.Render).names.toSet + "help"
    for o <- PbrtOptions.all do
      o.here match
        case Here.Same(_) => assert(ours(o.name), o.name)
        case _ => assert(!ours(o.name) || o.name == "verbose", o.name)

  test("docs/PBRT-OPTIONS.md is what the table says"):
    val help = "./sbt \"run describe --pbrt-options --outfile docs/PBRT-OPTIONS.md\""
    assert(Files.readString(Path.of("docs/PBRT-OPTIONS.md")) == PbrtOptions.page, help)

  private def parse(line: String) = CommandLine.parse(line.split(' ').toVector)
  private def options(line: String): Options = parse(line).fold(a => fail(a.err), identity)

  private val one = Options(files = Vector("a.pbrt"))
  private def switched(s: RenderSettings) = one.copy(settings = s)
  private def in(region: RenderRegion) =
    one.setting(_.copy(region = region))

  private val understood = Vector(
    "--ncores 3 a.pbrt --quick --quiet --verbose" ->
      switched(RenderSettings(quick = true)).copy(quiet = true, verbose = true)
        .controlling(_.copy(threads = 3)),
    "--ncores=3 a.pbrt" -> one.controlling(_.copy(threads = 3)),
    "-nthreads 2 -outfile b.exr a.pbrt" ->
      one.controlling(_.copy(threads = 2)).copy(outfiles = Vector("b.exr")),
    "--cropwindow 0 .5 .25 1 a.pbrt" ->
      in(RenderRegion.Window(0f, 0.5f, 0.25f, 1f)),
    "--cropwindow=0,.5,.25,1 a.pbrt" ->
      in(RenderRegion.Window(0f, 0.5f, 0.25f, 1f)),
    "--pixelbounds 3,9,2,5 a.pbrt" -> in(RenderRegion.Pixels(PixelBounds(3, 2, 9, 5))),
    "--pixel 7,8 a.pbrt" -> in(RenderRegion.Pixel(7, 8)),
    "--pixelmaterial 7,8 a.pbrt" -> one.copy(pixelMaterial = Some((7, 8))),
    "--stats a.pbrt" -> one.copy(verbose = true),
    "--v 2 a.pbrt" -> one.copy(verbose = true),
    "--disable-pixel-jitter a.pbrt" -> switched(RenderSettings(centers = true)),
    "--disablePixelJitter a.pbrt" -> switched(RenderSettings(centers = true)),
    "--disable_texture_filtering=true a.pbrt" -> switched(RenderSettings(unfiltered = true)),
    "--disable-texture-filtering=false a.pbrt" -> one,
    "--disable-image-textures a.pbrt" -> switched(RenderSettings(meanImages = true)),
    "--disable-wavelength-jitter a.pbrt" -> switched(RenderSettings(oneColorSet = true)),
    "--force-diffuse a.pbrt" -> switched(RenderSettings(diffuse = true)),
    "--displacement-edge-scale 2.5 a.pbrt" -> switched(RenderSettings(edgeScale = Some(2.5f))),
    "--mse-reference-image r.exr --mse-reference-out e.txt a.pbrt" ->
      switched(RenderSettings(output =
        OutputSettings(reference = Some("r.exr"), errors = Some("e.txt"))
      )),
    "--write-partial-images a.pbrt" -> one.copy(partialImages = true),
    "--wavefront --render-coord-sys world --log-level error --logtostderr a.pbrt" -> one,
    "--gpu a.pbrt" -> one.copy(notes =
      Vector("--gpu has no effect: the image is the same; it is rendered by processors")
    ),
    "--toply a.pbrt" -> one.copy(command = Command.Convert, toPly = Some(1)),
    "render --toply a.pbrt" -> one.copy(command = Command.Convert, toPly = Some(1)),
    "--cat a.pbrt" -> one.copy(command = Command.Convert),
    "a.pbrt --format" -> one.copy(command = Command.Convert),
    "--upgrade a.pbrt" -> one.copy(command = Command.Convert, to = Some(Dialect.V4))
  )

  for (line, meant) <- understood do
    test(s"`$line` means what it means in pbrt"):
      assert(options(line) == meant)

  private val refused = Vector(
    "--interactive a.pbrt" -> "--interactive is an option of pbrt; here, `candela move` moves",
    "--fullscreen a.pbrt" -> "--watch",
    "--debugstart 1,2 a.pbrt" -> "--pixel x,y --sample N --debug",
    "--pixelstats a.pbrt" -> "--aov variance",
    "--render-coord-sys eye a.pbrt" -> "must be camera, cameraworld or world, found `eye`",
    "--log-level=loud a.pbrt" -> "must be verbose, error or fatal, found `loud`",
    "--log-level" -> "must be verbose, error or fatal, but has no value",
    "--mse-reference-out e.txt a.pbrt" -> "must be given together",
    "--pixel 1,2 --cropwindow 0,1,0,1 a.pbrt" -> "only one of",
    "--pixelbounds 3,3,0,1 a.pbrt" -> "must be x0,x1,y0,y1 with x0 < x1",
    "--displacement-edge-scale 0 a.pbrt" -> "must be above 0",
    "--debug a.pbrt" -> "--debug needs --pixel x,y"
  )

  for (line, message) <- refused do
    test(s"`$line` says: $message"):
      val answer = parse(line).left.toOption.get
      assert(answer.code == ExitCode.BadUsage)
      assert(answer.err.contains(message), answer.err)

  test("what has no effect is said, unless nothing but errors is wanted"):
    def err(words: String*) =
      val captured = Captured()
      val _ = Main.run(words, captured.terminal)
      captured.err
    assert(err("--gpu", "none.pbrt").contains("warning: --gpu has no effect"))
    assert(!err("--gpu", "--quiet", "none.pbrt").contains("--gpu"))

  test("options of other commands are their own"):
    assert(parse("view a.exr --quick").isLeft)
    assert(options("compare --crop 1,2,3,4 a.exr b.exr").compare.crop.isDefined)
