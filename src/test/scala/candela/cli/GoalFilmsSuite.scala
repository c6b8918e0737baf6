package candela.cli

import candela.image.ImageFiles
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.nio.file.{Files, Path}

/** Renderings that end by a time or an error, and what is saved of them. */
class GoalFilmsSuite extends AnyFunSuite:

  private def withScene[A](sampler: String, integrator: String = FilmFilesSuite.Paths)(
      body: FilmFilesSuite.Folder => A
  ): A =
    TempFolder.use: folder =>
      val text = FilmFilesSuite.text(integrator, sampler)
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\" \"float radius\" 3\n")
      body(FilmFilesSuite.Folder(folder, scene))

  private def samples(f: FilmFilesSuite.Folder, name: String): Int = ImageSamples.of(f.bytes(name))

  test("a time goes on beyond the scene's samples", Slow):
    withScene("independent"): f =>
      // A millisecond each, after a start of half a second, or many on a busy machine
      f.render("--time", "4s", "--outfile", f("a.exr"))
      assert(samples(f, "a.exr") > 4)

  private val methods = Vector(
    FilmFilesSuite.Paths,
    "\"bdpt\" \"integer maxdepth\" 3",
    "\"mlt\" \"integer maxdepth\" 3 \"integer bootstrapsamples\" 500 " +
      "\"integer mutationsperpixel\" 4",
    "\"sppm\" \"integer maxdepth\" 3 \"float radius\" 0.3 \"integer maxiterations\" 4"
  )

  for integrator <- methods do
    val name = integrator.drop(1).takeWhile(_ != '"')
    test(s"an error goes on beyond the scene's samples; --spp is a ceiling: $name", Slow):
      withScene("independent", integrator): f =>
        f.render("--error", "0.03", "--outfile", f("b.exr"))
        assert(samples(f, "b.exr") > 4)
        val out = f.render("--error", "0.03", "--spp", "5", "--outfile", f("c.exr"))
        assert(samples(f, "c.exr") == 5)
        val why = "all 5 samples per pixel are taken [E1104]\n a larger --spp, or none, allows more"
        assert(out.contains(why))

  test("an image that ended by a goal is that of as many samples"):
    for sampler <- Vector("independent", "zsobol") do
      withScene(sampler): f =>
        f.render("--error", "0.05", "--outfile", f("a.exr"))
        val reached = samples(f, "a.exr")
        assert(reached > 4)
        val chosen = Vector("--sampler", "progressive", "--guiding", "auto")
        f.render(chosen ++ Vector("--spp", s"$reached", "--outfile", f("b.exr"))*)
        assert(f.bytes("a.exr") == f.bytes("b.exr"))
        f.render("--guiding", "off", "--error", "0.05", "--outfile", f("c.exr"))
        f.render("--sampler", "progressive", "--spp", s"${samples(f, "c.exr")}", "-o", f("d.exr"))
        assert(f.bytes("c.exr") == f.bytes("d.exr") && f.bytes("c.exr") != f.bytes("a.exr"))

  test("points of a fixed number are taken set by set, the same for any number of threads", Slow):
    for points <- Vector("zsobol", "stratified", "halton") do
      withScene("independent"): f =>
        def rendered(threads: String, file: String) =
          f.render("--error", "0.05", "--sampler", points, "-j", threads, "--outfile", f(file))
          f.bytes(file)
        assert(rendered("1", "a.exr") == rendered("3", "b.exr"))
        assert(samples(f, "a.exr") > 4)
        f.render("--error", "0.02", "--outfile", f("best.exr"))
        // The mean error of 0.05, and of 0.02: the images differ by no more
        val (image, best) = (f.image("a.exr").data, f.image("best.exr").data)
        val far = image.indices.map(i => (image(i) - best(i)) / (best(i) + 0.01)).map(d => d * d)
        assert(Math.sqrt(far.sum / far.size) < 0.07, points)

  test("whichever of a time and an error comes first ends a rendering"):
    withScene("independent"): f =>
      f.render("--time", "1h", "--error", "0.1", "--outfile", f("a.exr"))
      f.render("--error", "0.1", "--outfile", f("b.exr"))
      assert(samples(f, "a.exr") == samples(f, "b.exr"))
      // On a busy machine not even one sample ends until then
      val (code, _) =
        f.captured(Vector(f.scene, "--time", "0.5s", "--error", "1e-9", "--outfile", f("c.exr")))
      assert(code == 0 || code == 130)

  test("a goal continues films of any method and points beyond their samples", Slow):
    for (sampler, integrator) <- ("stratified", methods(0)) +: methods.map(("independent", _)) do
      withScene(sampler, integrator): f =>
        f.render("--sampler", "scene", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
        val first = samples(f, "a.exr")
        val out = f.run(Vector("resume", f("a.film"), "--error", "0.02"))
        val reached = samples(f, "a.exr")
        assert(reached > first, integrator)
        assert(out.contains(s", $reached spp (${reached - first} in this run), "), out)
        // Nothing is left to render
        val image = f.bytes("a.exr")
        f.run(Vector("resume", f("a.film")))
        assert(f.bytes("a.exr") == image)

  test(
    "a film that a goal took further can be resumed",
    Slow
  ):
    withScene("independent"): f =>
      f.render("--error", "0.02", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val many = samples(f, "a.exr")
      assert(many > 4)
      f.run(Vector("resume", f("a.film"), "--spp", s"${2 * many}"))
      val chosen = Vector("--sampler", "progressive", "--guiding", "auto")
      f.render(chosen ++ Vector("--spp", s"${2 * many}", "--outfile", f("b.exr"))*)
      assert(f.bytes("a.exr") == f.bytes("b.exr"))
      f.run(Vector("merge", f("a.film"), "--outfile", f("c.exr")))
      assert(samples(f, "c.exr") == 2 * many)

  test("an error that the film has already takes no samples"):
    withScene("independent"): f =>
      f.render("--error", "0.05", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val (image, reached) = (f.bytes("a.exr"), samples(f, "a.exr"))
      val out = f.run(Vector("resume", f("a.film"), "--error", "0.06"))
      assert(out.contains(s", $reached spp (none added), "), out)
      assert(out.contains("; --error was reached already"), out)
      assert(f.bytes("a.exr") == image)
      f.run(Vector("resume", f("a.film"), "--error", "0.02"))
      assert(samples(f, "a.exr") > reached)

  test("what is planned remains, though a time has ended the rendering"):
    withScene("independent"): f =>
      def planned = f.run(Vector("info", f("a.film"))).linesIterator
        .find(_.startsWith("samples")).get.split(" of ").last
      val words = Seq("--spp", "1000000", "--time", "0.01s")
      for _ <- 1 to 2 do
        f.render(words ++ Seq("--checkpoint", f("a.film"), "--outfile", f("a.exr"))*)
        assert(planned == "1000000 per pixel")
      f.run(Vector("resume", f("a.film"), "--time", "0.01s"))
      assert(planned == "1000000 per pixel")

  test("images of another goal are not done"):
    withScene("independent"): f =>
      val words = Seq("--skip-done", "--outfile", f("a.exr"))
      def skipped(more: String*) = f.render(words ++ more*).contains("1 skipped")
      assert(!skipped("--error", "0.1") && skipped("--error", "0.1"))
      assert(!skipped("--error", "0.05") && !skipped() && skipped())

  test("with --store-time, the samples of earlier runs are told beside the seconds of this one"):
    withScene("independent"): f =>
      f.render("--checkpoint", f("a.film"), "--store-time", "--outfile", f("a.exr"))
      f.run(Vector("resume", f("a.film"), "--spp", "20"))
      val facts = ImageFiles.facts(Path.of(f("a.exr"))).toMap
      assert(facts("samplesPerPixel") == "20" && facts("samplesPerPixelOfEarlierRuns") == "4")
